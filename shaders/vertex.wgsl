// The vertices, and their way into view space.
#import view

// As `Vertex` in amc-core/src/render/mod.rs.
struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec3<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) occlusion: vec2<f32>,
}

fn position_in_view(vertex: Vertex) -> vec3<f32> {
    return (view.object_to_view * vec4<f32>(vertex.position, 1.0)).xyz;
}

fn direction_in_view(direction: vec3<f32>) -> vec3<f32> {
    return (view.object_to_view * vec4<f32>(direction, 0.0)).xyz;
}

fn clip_position(p: vec3<f32>) -> vec4<f32> {
    return view.view_to_clip * vec4<f32>(p, 1.0);
}

// What multiplies the colour at this vertex, on the front and on the back.
fn vertex_light(vertex: Vertex) -> vec2<f32> {
    return select(vec2<f32>(1.0), vertex.occlusion, view.occlusion > 0.0);
}
