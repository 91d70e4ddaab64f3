// Shading mode: the AMC looked up by normal and tangent azimuth (paper, section 6).
#import amc_surface
#import color

@fragment
fn fragment_main(surface: AmcSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return opaque(amc_colour(surface, front));
}
