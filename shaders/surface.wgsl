// The surface at a fragment, and the vertex stage that sends it: shared by all modes but the AMC's own.
#import vertex
#import view_space

struct Surface {
    @builtin(position) clip: vec4<f32>,
    // Position in view space, and the light that occlusion leaves.
    @location(0) p_light: vec4<f32>,
    // Normal and tangent in view space, as they are interpolated.
    @location(1) n: vec3<f32>,
    @location(2) t: vec3<f32>,
    @location(3) uv: vec2<f32>,
}

@vertex
fn vertex_main(vertex: Vertex) -> Surface {
    let p = position_in_view(vertex);
    var surface: Surface;
    surface.clip = clip_position(p);
    surface.p_light = vec4<f32>(p, vertex_light(vertex));
    surface.n = direction_in_view(vertex.normal);
    surface.t = direction_in_view(vertex.tangent);
    surface.uv = vertex.uv;
    return surface;
}
