// How much of the Sun a place sees, by the shadow map. One module with shaders/shading.wgsl.

@group(0) @binding(2) var shadow_map: texture_depth_2d;
@group(0) @binding(3) var shadow_sampler: sampler;

const BLOCKER_TAPS: u32 = 10u;
const DISC_TAPS: u32 = 16u;

// The normal of the drawn mesh around a pixel's centre, from the samples beside it; the smooth one where they do not lie
// on one slope.
fn drawn_normal(center_at: vec2<u32>, smooth_normal: vec3<f32>) -> vec3<f32> {
    let east = seen_between(center_at + vec2(1u, 0u), 0.0, FARTHEST);
    let west = seen_between(center_at - vec2(1u, 0u), 0.0, FARTHEST);
    let south = seen_between(center_at + vec2(0u, 1u), 0.0, FARTHEST);
    let north = seen_between(center_at - vec2(0u, 1u), 0.0, FARTHEST);
    if min(min(east.share, west.share), min(south.share, north.share)) < 1.0 {
        return smooth_normal;
    }
    let across = cross(south.in_camera - north.in_camera, east.in_camera - west.in_camera);
    let normal = normalize(relative_place(across));
    return select(smooth_normal, normal, dot(normal, smooth_normal) > 0.3);
}

// Share of the Sun seen by a place on the drawn surface, 0 to 1. Texels are compared with the plane through the place, so
// that a slope does not shadow itself (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006). What the plane
// misses of the mesh within a texel or two grows with the tangent of the incidence; blockers nearer than that throw no
// shadow.
fn sunlight(place: vec3<f32>, plane: vec3<f32>) -> f32 {
    let cosine = clamp(dot(plane, shading.sun.xyz), 0.1, 1.0);
    let tangent = sqrt(1.0 - cosine * cosine) / cosine;
    let blind_m = max(shading.shadow.x, shading.shadow.y) * (0.5 + 0.5 * tangent);
    let at = (shading.shadow_from_relative * vec4(place + shading.sun.xyz * blind_m, 1.0)).xyz;
    if any(at.xy < vec2(0.0)) || any(at.xy > vec2(1.0)) {
        return 1.0;
    }
    let m = transpose(shading.shadow_from_relative);
    let across = vec3(
        dot(m[0].xyz, plane) / dot(m[0].xyz, m[0].xyz),
        dot(m[1].xyz, plane) / dot(m[1].xyz, m[1].xyz),
        -cosine / length(m[2].xyz),
    );
    let size = vec2<f32>(textureDimensions(shadow_map));
    let receiver = Receiver(at.xy * size, at.z, -across.xy / across.z / size);
    let reach = shading.shadow.w * shading.shadow.z / shading.shadow.xy; // of the solar disc, texels per depth
    let is_soft = max(reach.x, reach.y) * at.z > 0.5;
    var taps = 4u;
    var radius = vec2(0.0);
    if is_soft {
        radius = image_of_disc(receiver, reach);
        taps = select(0u, DISC_TAPS, radius.x > 0.0);
    }
    var light = 0.0;
    var direction = vec2(1.0, 0.0);
    for (var tap = 0u; tap < taps; tap++) {
        direction = next_on_disc(direction);
        let on_disc = radius * direction * sqrt((f32(tap) + 0.5) / f32(DISC_TAPS));
        light += lit_share(receiver, select(vec2(f32(tap & 1u), f32(tap >> 1u)) - 0.5, on_disc, is_soft));
    }
    return select(light / f32(taps), 1.0, taps == 0u);
}

// A plane in the shadow map that light may fall on.
struct Receiver {
    at: vec2<f32>,    // texels
    depth: f32,
    slope: vec2<f32>, // change of the depth a texel
}

// The direction of the next of many taps spread evenly over a disc: by the golden angle from the last one's, at the radius
// sqrt((tap + 1/2) / taps) (Vogel, "A better way to construct the sunflower head", 1979).
fn next_on_disc(last: vec2<f32>) -> vec2<f32> {
    const TURN = vec2(-0.73736888, 0.67549029);
    return vec2(last.x * TURN.x - last.y * TURN.y, last.x * TURN.y + last.y * TURN.x);
}

// Radii in texels of the solar disc's image from what blocks it, which is taken to lie at the mean depth of the blockers
// around (Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH sketches 2005); 0 if nothing blocks it.
fn image_of_disc(receiver: Receiver, reach: vec2<f32>) -> vec2<f32> {
    let widest = max(reach * receiver.depth, vec2(1.0));
    var blockers = 0.0;
    var gap = 0.0;
    var direction = vec2(1.0, 0.0);
    for (var tap = 0u; tap < BLOCKER_TAPS; tap++) {
        direction = next_on_disc(direction);
        let far = widest * direction * sqrt((f32(tap) + 0.5) / f32(BLOCKER_TAPS));
        let shift = floor(receiver.at + far) + 0.5 - receiver.at;
        let blocker = textureLoad(shadow_map, vec2<i32>(receiver.at + shift), 0);
        let behind = receiver.depth + dot(receiver.slope, shift) - blocker;
        blockers += step(0.0, behind);
        gap += max(behind, 0.0);
    }
    return select(vec2(0.0), max(reach * gap / max(blockers, 1.0), vec2(0.75)), blockers > 0.0);
}

// Share of the four texels around a place `shift` texels away that let light through to the plane.
fn lit_share(receiver: Receiver, shift: vec2<f32>) -> f32 {
    let tap = receiver.at + shift;
    let low = floor(tap - 0.5);
    let share = tap - 0.5 - low;
    let blockers = textureGather(shadow_map, shadow_sampler, (low + 1.0) / vec2<f32>(textureDimensions(shadow_map)));
    let slope = receiver.slope;
    let first = receiver.depth + dot(slope, low + 0.5 - receiver.at);
    let plane = first + vec4(slope.y, slope.x + slope.y, slope.x, 0.0);
    let lit = select(vec4(0.0), vec4(1.0), plane <= blockers);
    return mix(mix(lit.w, lit.z, share.x), mix(lit.x, lit.y, share.x), share.y);
}
