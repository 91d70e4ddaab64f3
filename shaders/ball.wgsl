// An ordinary MatCap: the picture of a ball, row 0 the top.

@group(1) @binding(0) var ball: texture_2d<f32>;
// Clamp; linear.
@group(1) @binding(1) var ball_sampler: sampler;

// Texture coordinates in a picture of a ball whose row 0 is the top, of the disc's `(n_x, n_y)`.
fn picture_coordinates(xy: vec2<f32>) -> vec2<f32> {
    return vec2<f32>((xy.x + 1.0) / 2.0, (1.0 - xy.y) / 2.0);
}

// The linear colour of the ball there.
fn look_up_ball(xy: vec2<f32>) -> vec3<f32> {
    return textureSampleLevel(ball, ball_sampler, picture_coordinates(xy), 0.0).rgb;
}
