// What the camera sees, sample by sample: straight from the pinhole picture, or through the map of a lens with distortion.
// One module with shaders/shading.wgsl.

@group(0) @binding(4) var lens_map: texture_2d<f32>; // of each of the camera's samples its place in the pinhole picture

// Whether the camera's samples differ from the pinhole picture's.
override LENS: bool = false;

const ONE_SLOPE: f32 = 0.01; // relative difference of depth within one surface at an edge

// One sample of the camera: what is seen there between two depths, where, and how much of it.
struct Seen {
    numbers: vec3<f32>,   // normal or gradient, and albedo
    in_camera: vec3<f32>, // m
    share: f32,           // 0 where nothing is hit
}

fn place_in_camera(raster: vec2<f32>, depth: f32) -> vec3<f32> {
    return vec3((raster - shading.raster.zw) / shading.raster.xy * depth, depth);
}

fn seen_between(at: vec2<u32>, near: f32, far: f32) -> Seen {
    if LENS {
        return seen_through_lens(textureLoad(lens_map, at, 0).xy, near, far);
    }
    let sample = textureLoad(samples, at, 0);
    let share = select(0.0, 1.0, sample.w > near && sample.w <= far);
    return Seen(sample.xyz, place_in_camera(vec2<f32>(at), sample.w), share);
}

// Between the four samples around a place in the pinhole picture, those between the two depths by their bilinear weight;
// 1/z is linear on a slope.
fn seen_through_lens(raster: vec2<f32>, near: f32, far: f32) -> Seen {
    let low = floor(raster);
    let part = raster - low;
    var sum = vec4(0.0); // numbers and 1/z
    var share = 0.0;
    for (var k = 0u; k < 4u; k++) {
        let corner = vec2(k & 1u, k >> 1u);
        let sample = textureLoad(samples, vec2<u32>(low) + corner, 0);
        if sample.w > near && sample.w <= far {
            let weights = select(1.0 - part, part, corner == vec2(1u));
            let weight = weights.x * weights.y;
            sum += weight * vec4(sample.xyz, 1.0 / sample.w);
            share += weight;
        }
    }
    if share <= 0.0 {
        return Seen(vec3(0.0), vec3(0.0), 0.0);
    }
    return Seen(sum.xyz / share, place_in_camera(raster, share / sum.w), share);
}

// What lies at a pixel's centre: all that is seen there if it is one slope, or what the nearest sample belongs to.
fn seen_at_center(at: vec2<u32>) -> Seen {
    if !LENS {
        return seen_between(at, 0.0, FARTHEST);
    }
    let raster = textureLoad(lens_map, at, 0).xy;
    let depth = textureLoad(samples, vec2<u32>(raster + 0.5), 0).w;
    if depth <= 0.0 {
        return Seen(vec3(0.0), vec3(0.0), 0.0);
    }
    if is_one_slope(vec2<u32>(raster)) {
        return seen_through_lens(raster, 0.0, FARTHEST);
    }
    return seen_through_lens(raster, depth * (1.0 - ONE_SLOPE), depth * (1.0 + ONE_SLOPE));
}

// Whether the four samples from `at` lie on one plane, for which 1/z is linear, within two samples' size.
fn is_one_slope(at: vec2<u32>) -> bool {
    let depths = vec4(
        textureLoad(samples, at, 0).w,
        textureLoad(samples, at + vec2(1u, 0u), 0).w,
        textureLoad(samples, at + vec2(0u, 1u), 0).w,
        textureLoad(samples, at + vec2(1u, 1u), 0).w,
    );
    if any(depths <= vec4(0.0)) {
        return false;
    }
    let inverse = 1.0 / depths;
    return abs(inverse.x + inverse.w - inverse.y - inverse.z) * depths.x * shading.raster.x < 2.0;
}
