// Shading mode: an ordinary MatCap, from a picture or as the mean over an AMC's slices (paper, section 5.3).
#import ball
#import color
#import perspective
#import surface
#import facing

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = facing_normal(surface.n_back.xyz, front);
    let colour = look_up_ball(look_up_normal(surface.p_front.xyz, n));
    return opaque(colour * seen_light(surface.p_front.w, surface.n_back.w, front));
}
