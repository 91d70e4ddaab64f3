// Colours as the fragment stages return them. The transfer function is IEC 61966-2-1, as in amc-core/src/color.rs.

// Whether the target keeps what is written as it is and is shown as sRGB: then the colour is encoded here.
override encode_output: bool = false;

// Linear light of sRGB-encoded values, both in 0..=1: what the views of normals, tangents and UVs store.
fn linear_colour(encoded: vec3<f32>) -> vec3<f32> {
    let low = encoded / 12.92;
    let high = pow((max(encoded, vec3<f32>(0.04045)) + 0.055) / 1.055, vec3<f32>(2.4));
    return select(high, low, encoded <= vec3<f32>(0.04045));
}

// The sRGB encoding of linear light; clamped to 0..=1.
fn srgb_from_linear(linear: vec3<f32>) -> vec3<f32> {
    let light = clamp(linear, vec3<f32>(0.0), vec3<f32>(1.0));
    let low = light * 12.92;
    let high = 1.055 * pow(max(light, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, light <= vec3<f32>(0.0031308));
}

// What a fragment stage returns for the linear colour of an opaque surface.
fn opaque(linear: vec3<f32>) -> vec4<f32> {
    if encode_output {
        return vec4<f32>(srgb_from_linear(linear), 1.0);
    }
    return vec4<f32>(linear, 1.0);
}
