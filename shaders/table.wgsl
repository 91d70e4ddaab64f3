// The Anisotropic MatCap of one fabric, as a 3D texture: columns by n_x, rows by n_y upwards, slices by azimuth.

// Laid out as `FabricUniforms` in amc-core/src/render/gpu/uniforms.rs.
struct Fabric {
    // R: the table holds 1/R of a turn.
    symmetry: f32,
    // Sk.
    slices: f32,
    // A uniform buffer of OpenGL ES is a multiple of 16 bytes.
    padding: vec2<f32>,
}

@group(1) @binding(0) var<uniform> fabric: Fabric;
@group(1) @binding(1) var table: texture_3d<f32>;
// Clamp, clamp, repeat; linear.
@group(1) @binding(2) var table_sampler: sampler;

// Texture coordinates in a table, of the disc's `(n_x, n_y)` and of `kappa` in turns of the axis. Slice s holds an
// azimuth, but a texture's slices are centred half a step on.
fn table_coordinates(xy: vec2<f32>, kappa: f32, slices: f32) -> vec3<f32> {
    return vec3<f32>((xy + 1.0) / 2.0, kappa + 0.5 / slices);
}

// The linear colour of the fabric there.
fn look_up(xy: vec2<f32>, kappa: f32) -> vec3<f32> {
    let at = table_coordinates(xy, kappa, fabric.slices);
    return textureSampleLevel(table, table_sampler, at, 0.0).rgb;
}
