// Cloth is two-sided.
#import view_space

// The unit normal of a fragment from the interpolated one; negated on a back face, where the tangent is kept.
fn facing_normal(n: vec3<f32>, front: bool) -> vec3<f32> {
    let unit = normalize_or(n, vec3<f32>(0.0, 0.0, 1.0));
    return select(-unit, unit, front);
}

// A unit direction as a colour, sRGB-encoded values.
fn direction_colour(direction: vec3<f32>) -> vec3<f32> {
    return direction / 2.0 + 0.5;
}

// Of the light that occlusion leaves on the front and on the back, that of the side which is seen. Twin in
// amc-core/src/render/shade.rs.
fn seen_light(on_front: f32, on_back: f32, front: bool) -> f32 {
    return select(on_back, on_front, front);
}
