// The turn of normals and tangents where the line of sight is not the optical axis.
#import view_space

// 0 off (and every orthographic view), 1 paper, 2 full, 3 half.
override perspective_mode: u32 = 3u;

// A normal and a tangent in the frame a table is looked up in. Not of unit length in mode `paper`.
struct TurnedFrame {
    n: vec3<f32>,
    t: vec3<f32>,
}

// The unit vector from a point of view space towards the eye, in a perspective view.
fn towards_eye(p: vec3<f32>) -> vec3<f32> {
    return normalize_or(-p, vec3<f32>(0.0, 0.0, 1.0));
}

// Equation 4 of the paper with `p` in view space; z is kept.
fn paper_turn(p: vec3<f32>, x: vec3<f32>) -> vec3<f32> {
    let slope = p.xy / min(p.z, -1e-6);
    return vec3<f32>((x.xy - slope * x.z) * inverseSqrt(1.0 + slope * slope), x.z);
}

// What is turned to +z in the modes `full` and `half`.
fn turned_axis(p: vec3<f32>) -> vec3<f32> {
    let v = towards_eye(p);
    if perspective_mode == 2u {
        return v;
    }
    let z = vec3<f32>(0.0, 0.0, 1.0);
    return normalize_or(v + z, z);
}

// Turns the unit normal `n` and the tangent `t` at the view-space position `p` for perspective.
fn perspective_turn(p: vec3<f32>, n: vec3<f32>, t: vec3<f32>) -> TurnedFrame {
    if perspective_mode == 0u {
        return TurnedFrame(n, t);
    }
    if perspective_mode == 1u {
        return TurnedFrame(paper_turn(p, n), paper_turn(p, t));
    }
    let axis = turned_axis(p);
    return TurnedFrame(turn_to_z(n, axis), turn_to_z(t, axis));
}

// `(n_x, n_y)` to look up: where the turned normal looks away from the viewer, or leaves the disc, the disc's rim.
fn disc_normal(n: vec3<f32>) -> vec2<f32> {
    let square = dot(n.xy, n.xy);
    return select(n.xy, n.xy * inverseSqrt(max(square, 1e-12)), n.z < 0.0 || square > 1.0);
}

// `(n_x, n_y)` at which tables and MatCap pictures are looked up: the facing normal `n` at the view-space position `p`.
fn look_up_normal(p: vec3<f32>, n: vec3<f32>) -> vec2<f32> {
    return disc_normal(perspective_turn(p, n, n).n);
}
