// Shading mode of parts without a fabric: plain grey, lit from the viewer.
#import color
#import surface
#import facing

const PLAIN_GREY: f32 = 0.35;

// Linear. Twin in amc-core/src/render/shade.rs.
fn plain(n_z: f32) -> vec3<f32> {
    return vec3<f32>(PLAIN_GREY * (0.3 + 0.7 * max(n_z, 0.0)));
}

@fragment
fn fragment_main(surface: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return opaque(plain(facing_normal(surface.n_back.xyz, front).z) * seen_light(surface.p_front.w, surface.n_back.w, front));
}
