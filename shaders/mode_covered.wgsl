// Shading mode: a picture alone, lit from the viewer.
#import color
#import surface
#import facing
#import print

// What multiplies the picture. Twin in amc-core/src/render/shade.rs.
fn cover_light(n_z: f32) -> f32 {
    return 0.45 + 0.55 * max(n_z, 0.0);
}

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let light = cover_light(facing_normal(surface.n_back.xyz, front).z) * seen_light(surface.p_front.w, surface.n_back.w, front);
    return opaque(look_up_print(surface.uv) * light);
}
