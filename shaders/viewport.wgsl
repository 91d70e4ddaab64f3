// A drawn picture as the window shows it, pixel for pixel, with outlines around marked panels.
#import color

// Laid out as `OutlineUniforms` in app/src/viewport/blit.rs.
struct Outline {
    // Linear colours and, in w, widths in pixels; 0: none.
    selected: vec4<f32>,
    hovered: vec4<f32>,
}

// Linear light, opaque.
@group(0) @binding(0) var picture: texture_2d<f32>;
// `mark.wgsl`'s: bit 0 selected, bit 1 hovered.
@group(0) @binding(1) var marks: texture_2d<f32>;
@group(0) @binding(2) var<uniform> outline: Outline;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    // From the top-left corner (0, 0) to the other one (1, 1).
    @location(0) place: vec2<f32>,
}

// One triangle that covers the viewport.
@vertex
fn vertex_main(@builtin(vertex_index) index: u32) -> Corner {
    let place = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    var corner: Corner;
    corner.clip = vec4<f32>(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, 0.0, 1.0);
    corner.place = place;
    return corner;
}

// Whether the panel seen at a texel is selected, and whether it is hovered: 1 or 0.
fn marks_at(texel: vec2<i32>) -> vec2<f32> {
    let last = vec2<i32>(textureDimensions(marks)) - 1;
    let mark = u32(textureLoad(marks, clamp(texel, vec2<i32>(0), last), 0).r * 255.0 + 0.5);
    return vec2<f32>(f32(mark & 1u), f32((mark >> 1u) & 1u));
}

// How much of a texel the outlines cover. They lie outside of what they surround, whose own colour is judged.
fn outline_shares(texel: vec2<i32>) -> vec2<f32> {
    let widths = vec2<f32>(outline.selected.w, outline.hovered.w);
    let reach = i32(ceil(max(widths.x, widths.y)));
    var shares = vec2<f32>(0.0);
    for (var y = -reach; y <= reach; y++) {
        for (var x = -reach; x <= reach; x++) {
            let near = clamp(widths + 0.5 - length(vec2<f32>(f32(x), f32(y))), vec2<f32>(0.0), vec2<f32>(1.0));
            shares = max(shares, near * marks_at(texel + vec2<i32>(x, y)));
        }
    }
    return select(shares * (1.0 - marks_at(texel)), vec2<f32>(0.0), widths <= vec2<f32>(0.0));
}

@fragment
fn fragment_main(corner: Corner) -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(picture));
    let texel = clamp(vec2<i32>(corner.place * vec2<f32>(size)), vec2<i32>(0), size - 1);
    var colour = textureLoad(picture, texel, 0).rgb;
    if max(outline.selected.w, outline.hovered.w) > 0.0 {
        let shares = outline_shares(texel);
        colour = mix(colour, outline.hovered.rgb, shares.y);
        colour = mix(colour, outline.selected.rgb, shares.x);
    }
    return opaque(colour);
}
