// The colour of a fragment of an ordinary MatCap, from a picture or as the mean over an AMC's slices (paper, section 5.3).
#import ball
#import perspective
#import surface
#import facing

// Linear.
fn ball_colour(surface: Surface, front: bool) -> vec3<f32> {
    let n = facing_normal(surface.n_back.xyz, front);
    let colour = look_up_ball(look_up_normal(surface.p_front.xyz, n));
    return colour * seen_light(surface.p_front.w, surface.n_back.w, front);
}
