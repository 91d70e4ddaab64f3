// The surface at a fragment of the AMC's shading mode, the vertex stage that sends it, and the fabric's colour there (paper, section 6).
#import cyclic
#import perspective
#import table
#import facing
#import vertex
#import view_space

struct AmcSurface {
    @builtin(position) clip: vec4<f32>,
    // Position in view space, and the light that occlusion leaves on the front.
    @location(0) p_front: vec4<f32>,
    // Normal in view space, and the light on the back.
    @location(1) n_back: vec4<f32>,
    // Cyclic mode `fragment`: the tangent in view space; else the kappas of `vertex_kappa`.
    @location(2) direction: vec4<f32>,
    @location(3) uv: vec2<f32>,
}

@vertex
fn vertex_main(vertex: Vertex) -> AmcSurface {
    let p = position_in_view(vertex);
    let n = direction_in_view(vertex.normal);
    let t = direction_in_view(vertex.tangent);
    var surface: AmcSurface;
    surface.clip = clip_position(p);
    let light = vertex_light(vertex);
    surface.p_front = vec4<f32>(p, light.x);
    surface.n_back = vec4<f32>(n, light.y);
    if cyclic_mode == 2u {
        surface.direction = vec4<f32>(t, 0.0);
    } else {
        let unit = normalize_or(n, vec3<f32>(0.0, 0.0, 1.0));
        surface.direction = vertex_kappa(fabric.symmetry, p, unit, perpendicular(t, unit));
    }
    surface.uv = vertex.uv;
    return surface;
}

// Linear.
fn amc_colour(surface: AmcSurface, front: bool) -> vec3<f32> {
    let p = surface.p_front.xyz;
    let n = facing_normal(surface.n_back.xyz, front);
    var turns: f32;
    if cyclic_mode == 2u {
        turns = fragment_kappa(fabric.symmetry, p, n, surface.direction.xyz);
    } else {
        let pair = select(surface.direction.zw, surface.direction.xy, front);
        turns = pair.x;
        if cyclic_mode == 1u {
            turns = cyclic_choice(pair, fwidth(pair));
        }
    }
    return look_up(look_up_normal(p, n), turns) * seen_light(surface.p_front.w, surface.n_back.w, front);
}
