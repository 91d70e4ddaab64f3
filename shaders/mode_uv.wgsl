// Shading mode: the UV coordinates, sRGB-encoded values.
#import color
#import surface

// The fractional parts in red and green, a checker of ten squares to the unit in blue. Twin in amc-core/src/render/shade.rs.
fn uv_colour(uv: vec2<f32>) -> vec3<f32> {
    let square = floor(uv * 10.0);
    let odd = (square.x + square.y) - 2.0 * floor((square.x + square.y) / 2.0);
    return vec3<f32>(uv - floor(uv), 0.25 + 0.5 * odd);
}

@fragment
fn fragment_main(surface: Surface) -> @location(0) vec4<f32> {
    return opaque(linear_colour(uv_colour(surface.uv)));
}
