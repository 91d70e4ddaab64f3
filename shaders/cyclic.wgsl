// The cyclic coordinate of the azimuth (paper, section 6.2).
#import perspective
#import view_space

// How it gets from vertices to fragments: 0 naive, 1 cyclic, 2 fragment.
override cyclic_mode: u32 = 1u;

const TURN: f32 = 6.283185307179586;

// `kappa = R phi / (2 pi)`, in turns of the table's axis, unbounded.
fn kappa(symmetry: f32, frame: TurnedFrame) -> f32 {
    return symmetry * azimuth_of(frame.n, frame.t) / TURN;
}

// `kappa mod 1` in [0, 1) and its twin `kappa - floor(kappa - 1/2)` in [1/2, 3/2).
fn cyclic_pair(kappa: f32) -> vec2<f32> {
    return vec2<f32>(kappa - floor(kappa), kappa - floor(kappa - 0.5));
}

// The one of an interpolated pair whose absolute derivative is smaller; `width` is `|d/dx| + |d/dy|` of each.
fn cyclic_choice(pair: vec2<f32>, width: vec2<f32>) -> f32 {
    return select(pair.x, pair.y, width.y < width.x);
}

// What the vertex stage sends for the azimuth: the cyclic pair for the front (x, y) and for the back (z, w), where
// the normal is negated. `n`, `t` of unit length and perpendicular, at the view-space position `p`.
fn vertex_kappa(symmetry: f32, p: vec3<f32>, n: vec3<f32>, t: vec3<f32>) -> vec4<f32> {
    let front = cyclic_pair(kappa(symmetry, perspective_turn(p, n, t)));
    let back = cyclic_pair(kappa(symmetry, perspective_turn(p, -n, t)));
    return vec4<f32>(front, back);
}

// The azimuth per fragment: `n` is of unit length and faces the viewer's side; `t` is the interpolated tangent.
fn fragment_kappa(symmetry: f32, p: vec3<f32>, n: vec3<f32>, t: vec3<f32>) -> f32 {
    return kappa(symmetry, perspective_turn(p, n, perpendicular(t, n)));
}
