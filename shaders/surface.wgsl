// The surface at a fragment, and the vertex stage that sends it: shared by all modes but the AMC's own.
#import vertex
#import view_space

struct Surface {
    @builtin(position) clip: vec4<f32>,
    // Position in view space, and the light that occlusion leaves on the front.
    @location(0) p_front: vec4<f32>,
    // Normal in view space, as it is interpolated, and the light on the back.
    @location(1) n_back: vec4<f32>,
    // Tangent in view space, as it is interpolated.
    @location(2) t: vec3<f32>,
    @location(3) uv: vec2<f32>,
}

@vertex
fn vertex_main(vertex: Vertex) -> Surface {
    let p = position_in_view(vertex);
    var surface: Surface;
    surface.clip = clip_position(p);
    let light = vertex_light(vertex);
    surface.p_front = vec4<f32>(p, light.x);
    surface.n_back = vec4<f32>(direction_in_view(vertex.normal), light.y);
    surface.t = direction_in_view(vertex.tangent);
    surface.uv = vertex.uv;
    return surface;
}
