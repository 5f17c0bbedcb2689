// How much of the Sun a place sees, by the shadow map. One module with shaders/shading.wgsl.

@group(0) @binding(2) var shadow_map: texture_depth_2d;
@group(0) @binding(3) var shadow_sampler: sampler;

const BLOCKER_TAPS: u32 = 10u;
const DISC_TAPS: u32 = 16u;
// Half shadow up to this radius is left to the map's own blur, texels.
override NARROW: f32 = 1.0;
// Whether half shadow may be wider anywhere in the picture.
override WIDE_PENUMBRA: bool = true;

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

// How far before a place blockers throw no shadow on it, m. Texels are compared with the plane through the place, so that a
// slope does not shadow itself (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006). What the plane misses of
// the surface within a texel or two grows with the tangent of the incidence: a body has to be spared that. Of terrain the map
// has only what faces away from the Sun, which never lies before lit ground, but itself has to be dark.
fn blind_m(cosine: f32) -> f32 {
    let tangent = sqrt(1.0 - cosine * cosine) / cosine;
    let texels = select(0.5 + 0.5 * tangent, -0.25 - 0.75 * tangent, TERRAIN);
    return texels * max(shading.shadow.x, shading.shadow.y);
}

// Share of the Sun seen by a place on the drawn surface, 0 to 1.
fn sunlight(place: vec3<f32>, plane: vec3<f32>) -> f32 {
    let cosine = clamp(dot(plane, shading.sun.xyz), 0.1, 1.0);
    let at = (shading.shadow_from_relative * vec4(place + shading.sun.xyz * blind_m(cosine), 1.0)).xyz;
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
    let widest = reach * farthest_gap(place, at.z);
    var light = lit_around(receiver);
    if WIDE_PENUMBRA && max(widest.x, widest.y) > NARROW {
        let radius = image_of_disc(receiver, reach, widest);
        if radius.x > 0.0 {
            light = lit_on_disc(receiver, radius);
        } else {
            light = 1.0;
        }
    }
    return light;
}

// How far from a place, in depths of the map, what blocks its light may lie: no ground is higher than the highest drawn.
fn farthest_gap(place: vec3<f32>, depth: f32) -> f32 {
    if !TERRAIN {
        return depth;
    }
    let above_m = max(shading.surface.z - place.z, 0.0);
    return min(depth, above_m / (max(shading.sun.z, 1e-3) * shading.shadow.z));
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
fn image_of_disc(receiver: Receiver, reach: vec2<f32>, widest: vec2<f32>) -> vec2<f32> {
    let around = max(widest, vec2(1.0));
    var blockers = 0.0;
    var gap = 0.0;
    var direction = vec2(1.0, 0.0);
    var tap = 0u;
    loop {
        direction = next_on_disc(direction);
        let far = around * direction * sqrt((f32(tap) + 0.5) / f32(BLOCKER_TAPS));
        let texel = floor(receiver.at + far);
        let behind = depth_behind(receiver, vec2<i32>(texel));
        blockers += step(0.0, behind);
        gap += max(behind, 0.0);
        tap++;
        if tap == BLOCKER_TAPS {
            break;
        }
    }
    return select(vec2(0.0), max(reach * gap / max(blockers, 1.0), vec2(0.75)), blockers > 0.0);
}

// How far a texel's surface lies before the plane, in depths of the map; negative if behind it.
fn depth_behind(receiver: Receiver, texel: vec2<i32>) -> f32 {
    let plane = receiver.depth + dot(receiver.slope, vec2<f32>(texel) + 0.5 - receiver.at);
    return plane - textureLoad(shadow_map, texel, 0);
}

// Share of the light that passes the three by three texels around a place, those beside by how near they are: two texels
// wide, blurred by one.
fn lit_around(receiver: Receiver) -> f32 {
    let size = vec2<i32>(textureDimensions(shadow_map));
    let low = floor(receiver.at);
    let middle = clamp(vec2<i32>(low), vec2(1), size - 2);
    let part = receiver.at - low;
    let weight_x = vec3(0.5 - 0.5 * part.x, 0.5, 0.5 * part.x);
    let weight_y = vec3(0.5 - 0.5 * part.y, 0.5, 0.5 * part.y);
    var light = 0.0;
    for (var row = 0; row < 3; row++) {
        let first = middle + vec2(-1, row - 1);
        let behind = vec3(
            depth_behind(receiver, first),
            depth_behind(receiver, first + vec2(1, 0)),
            depth_behind(receiver, first + vec2(2, 0)),
        );
        light += weight_y[row] * dot(weight_x, select(vec3(0.0), vec3(1.0), behind <= vec3(0.0)));
    }
    return light;
}

// Share of the light that passes the map within an ellipse of the given radii in texels.
fn lit_on_disc(receiver: Receiver, radius: vec2<f32>) -> f32 {
    var light = 0.0;
    var direction = vec2(1.0, 0.0);
    var tap = 0u;
    loop {
        direction = next_on_disc(direction);
        light += lit_share(receiver, radius * direction * sqrt((f32(tap) + 0.5) / f32(DISC_TAPS)));
        tap++;
        if tap == DISC_TAPS {
            break;
        }
    }
    return light / f32(DISC_TAPS);
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
