// Shading mode: the view-space normal after two-sidedness, n/2 + 1/2 as sRGB-encoded values.
#import color
#import surface
#import facing

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return opaque(linear_colour(direction_colour(facing_normal(surface.n_back.xyz, front))));
}
