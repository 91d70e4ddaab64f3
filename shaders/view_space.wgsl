// Directions in view space: right-handed, +x right, +y up, +z towards the viewer.
// Every function has a twin of the same name in amc-core/src/view_space.rs.

// What the azimuth of a tangent means: 0 transported, 1 projected.
override azimuth_definition: u32 = 0u;

// Any unit vector perpendicular to the unit vector `n`.
// T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
fn any_orthonormal_vector(n: vec3<f32>) -> vec3<f32> {
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (side + n.z);
    return vec3<f32>(n.x * n.y * a, side + n.y * n.y * a, -n.y);
}

// The unit vector along `x`, or `otherwise` where `x` has no direction.
fn normalize_or(x: vec3<f32>, otherwise: vec3<f32>) -> vec3<f32> {
    let square = dot(x, x);
    return select(otherwise, x * inverseSqrt(square), square > 0.0);
}

// The unit vector along `t` made perpendicular to the unit vector `n`.
fn perpendicular(t: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    return normalize_or(t - n * dot(n, t), any_orthonormal_vector(n));
}

// `x` turned by the least rotation that takes the unit vector `a` to +z.
fn turn_to_z(x: vec3<f32>, a: vec3<f32>) -> vec3<f32> {
    let a_dot_x = dot(a, x);
    let s = (a_dot_x + x.z) / max(1.0 + a.z, 1e-6);
    return x - vec3<f32>(a.xy, a.z + 1.0) * s + vec3<f32>(0.0, 0.0, 2.0 * a_dot_x);
}

// `x` turned by the least rotation that takes +z to the unit vector `a`.
fn turn_from_z(x: vec3<f32>, a: vec3<f32>) -> vec3<f32> {
    let s = (dot(a, x) + x.z) / max(1.0 + a.z, 1e-6);
    return x - vec3<f32>(a.xy, a.z + 1.0) * s + a * (2.0 * x.z);
}

// atan2, defined where both are 0 (there WGSL's is not).
fn angle_of(y: f32, x: f32) -> f32 {
    return select(atan2(y, x), 0.0, x == 0.0 && y == 0.0);
}

// The transported azimuth of the tangent `t` at the normal `n`.
fn transported_azimuth(n: vec3<f32>, t: vec3<f32>) -> f32 {
    let s = t.z / max(1.0 + n.z, 1e-6);
    return angle_of(t.y - n.y * s, t.x - n.x * s);
}

// The projected azimuth of the tangent `t`; 0 where `t` points at the eye.
fn projected_azimuth(t: vec3<f32>) -> f32 {
    return angle_of(t.y, t.x);
}

// The azimuth of the tangent `t` at the normal `n`; twin of `Azimuth::of`.
fn azimuth_of(n: vec3<f32>, t: vec3<f32>) -> f32 {
    if azimuth_definition == 1u {
        return projected_azimuth(t);
    }
    return transported_azimuth(n, t);
}

// The unit tangent perpendicular to `n` (with `n.z >= 0`) whose azimuth is `phi`; twin of `Azimuth::tangent`.
fn azimuth_tangent(n: vec3<f32>, phi: f32) -> vec3<f32> {
    let along = vec3<f32>(cos(phi), sin(phi), 0.0);
    if azimuth_definition == 1u {
        let t = vec3<f32>(along.xy * n.z, -dot(n.xy, along.xy));
        return normalize_or(t, perpendicular(along, n));
    }
    return turn_from_z(along, n);
}
