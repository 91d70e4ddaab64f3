// From where the drawing is seen. Laid out as `ViewUniforms` in amc-core/src/render/gpu/uniforms.rs.

struct View {
    // Object space to view space: a rotation and a shift.
    object_to_view: mat4x4<f32>,
    // View space to clip space, depth 0 to 1.
    view_to_clip: mat4x4<f32>,
    // 1: the vertices' occlusion multiplies the colour; 0: it does not.
    occlusion: f32,
}

@group(0) @binding(0) var<uniform> view: View;
