// Shading mode: an ordinary MatCap.
#import ball_surface
#import color

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return opaque(ball_colour(surface, front));
}
