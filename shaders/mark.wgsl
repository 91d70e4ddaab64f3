// Panels as marks: what an overlay outlines, or tells panels apart by.
#import vertex

// 0 to 255.
override mark: u32 = 0u;

@vertex
fn vertex_main(vertex: Vertex) -> @builtin(position) vec4<f32> {
    return clip_position(position_in_view(vertex));
}

@fragment
fn fragment_main() -> @location(0) vec4<f32> {
    return vec4<f32>(f32(mark) / 255.0, 0.0, 0.0, 1.0);
}
