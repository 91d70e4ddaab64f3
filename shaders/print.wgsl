// A colour picture over a fabric, multiplied in.

// Laid out as `PrintUniforms` in amc-core/src/render/gpu/uniforms.rs.
struct Print {
    // From UVs to the picture: the dot products of (u, v, 1) with xyz are 0 to 1 from its left to its right, and from
    // its top down.
    across: vec4<f32>,
    down: vec4<f32>,
    // Columns and rows of level 0, the number of the last level, and 1 where the picture is repeated.
    picture: vec4<f32>,
}

@group(2) @binding(0) var<uniform> print: Print;
@group(2) @binding(1) var print_picture: texture_2d<f32>;
// Repeat; linear within a level.
@group(2) @binding(2) var print_sampler: sampler;

// What multiplies the linear colour there: mixed from the two levels whose pixels are nearest to the screen's. Twin in
// amc-core/src/render/print.rs.
fn look_up_print(uv: vec2<f32>) -> vec3<f32> {
    let place = vec3<f32>(uv, 1.0);
    let at = vec2<f32>(dot(print.across.xyz, place), dot(print.down.xyz, place));
    let width = max(length(dpdx(at) * print.picture.xy), length(dpdy(at) * print.picture.xy));
    let level = clamp(log2(max(width, 1.0)), 0.0, print.picture.z);
    let fine = floor(level);
    let coarse = min(fine + 1.0, print.picture.z);
    let ink = mix(
        textureSampleLevel(print_picture, print_sampler, at, fine),
        textureSampleLevel(print_picture, print_sampler, at, coarse),
        level - fine,
    );
    let is_inside = all(at >= vec2<f32>(0.0)) && all(at < vec2<f32>(1.0));
    return select(vec3<f32>(1.0), ink.rgb, is_inside || print.picture.w > 0.0);
}
