// Shading mode: an ordinary MatCap with a print over it.
#import ball_surface
#import color
#import print

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return opaque(ball_colour(surface, front) * look_up_print(surface.uv));
}
