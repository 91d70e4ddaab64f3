// Shading mode: the AMC with a print over it.
#import amc_surface
#import color
#import print

@fragment
fn fragment_main(surface: AmcSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return opaque(amc_colour(surface, front) * look_up_print(surface.uv));
}
