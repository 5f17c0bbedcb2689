// A small body's mesh: surface normal (its length is the albedo over the mean) and depth of each sample.

struct Geometry {
    clip_from_relative: mat4x4<f32>, // relative = reference axes, camera at the origin, m
    forward: vec4<f32>,              // optical axis in reference axes
    camera_high: vec4<f32>,          // camera position
    camera_low: vec4<f32>,           // what f32 dropped of it
    level: vec4<f32>,                // unused
}

@group(0) @binding(0) var<uniform> geometry: Geometry;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) sample: vec4<f32>, // normal, and depth m
}

fn relative_to_camera(position: vec3<f32>) -> vec3<f32> {
    return (position - geometry.camera_high.xyz) - geometry.camera_low.xyz;
}

fn placed(position: vec3<f32>, normal: vec3<f32>) -> Varying {
    let relative = relative_to_camera(position);
    let clip = geometry.clip_from_relative * vec4(relative, 1.0);
    return Varying(clip, vec4(normal, dot(geometry.forward.xyz, relative)));
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Varying {
    return placed(position, normal);
}

@vertex
fn shadow_vertex(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return geometry.clip_from_relative * vec4(relative_to_camera(position), 1.0);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    return vec4(normalize(in.sample.xyz), in.sample.w);
}
