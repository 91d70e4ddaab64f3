// Shading mode: the view-space tangent made perpendicular to the normal, t/2 + 1/2 as sRGB-encoded values.
#import color
#import surface
#import facing

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let t = perpendicular(surface.t, facing_normal(surface.n_back.xyz, front));
    return opaque(linear_colour(direction_colour(t)));
}
