// From surface samples to radiance, depth and mask: photometry, cast shadows, and detail below the mesh's resolution.
// Follows shaders/noise.wgsl and shaders/photometry.wgsl in one module.

struct Shading {
    reference_from_camera: mat4x4<f32>, // rotation
    shadow_from_relative: mat4x4<f32>,  // relative = reference axes, camera at the origin, m
    sun: vec4<f32>,       // direction in reference axes; w = radiance of the sky over that of a sunlit white surface
    focal: vec4<f32>,     // focal lengths of the camera in px
    raster: vec4<f32>,    // focal lengths and principal point of the pinhole picture in samples
    surface: vec4<f32>,   // mean albedo, unused, r.m.s. slope of the detail
    shadow: vec4<f32>,    // texel's width and height in m, depth of the map in m, tangent of the Sun's radius
    level: vec4<f32>,     // terrain: height above ground m, range over spacing, morph start, morph end
    counts: vec4<u32>,    // taps, stride, octaves
    photometry: Photometry,
    octaves: array<Octave, OCTAVES>,
}

@group(0) @binding(0) var<uniform> shading: Shading;
@group(0) @binding(1) var samples: texture_2d<f32>;
@group(0) @binding(2) var shadow_map: texture_depth_2d;
@group(0) @binding(3) var shadow_sampler: sampler;
@group(0) @binding(4) var lens_map: texture_2d<f32>; // of each of the camera's samples its place in the pinhole picture

// Whether the camera's samples differ from the pinhole picture's.
override LENS: bool = false;

struct Surface {
    relative: vec3<f32>, // m
    smooth_normal: vec3<f32>,
    normal: vec3<f32>,
    albedo: f32,
}

struct Outputs {
    @location(0) radiance: f32,
    @location(1) depth: f32,
    @location(2) mask: u32,
}

const BODY: u32 = 1u;
const LIT: u32 = 2u;
const TERMINATOR: u32 = 4u;
const TERMINATOR_COSINE: f32 = 0.17364818; // incidence of 80 to 100 degrees
const BLOCKER_TAPS: u32 = 10u;
const DISC_TAPS: u32 = 16u;
const FARTHEST: f32 = 3.0e38; // m
const ONE_SLOPE: f32 = 0.01; // relative difference of depth within one surface at an edge
const FINEST_SPACING_LOG2: f32 = -8.0;
const SHADE_SPACINGS: f32 = 8.0; // as in src/render/terrain_tile.rs

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32((index << 1u) & 2u) * 2.0 - 1.0, f32(index & 2u) * 2.0 - 1.0, 0.5, 1.0);
}

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

fn relative_place(in_camera: vec3<f32>) -> vec3<f32> {
    return (shading.reference_from_camera * vec4(in_camera, 0.0)).xyz;
}

fn footprint_m(relative: vec3<f32>, depth: f32, normal: vec3<f32>) -> f32 {
    let cosine = abs(dot(normalize(relative), normal));
    return depth * inverseSqrt(shading.focal.x * shading.focal.y * max(cosine, 0.1));
}

// Share of the octave that the vertices of the terrain's mesh already carry.
fn carried_by_mesh(wavelength_m: f32, relative: vec3<f32>) -> f32 {
    let distance = sqrt(dot(relative.xy, relative.xy) + shading.level.x * shading.level.x);
    let spacing = exp2(max(ceil(log2(distance / shading.level.y)), FINEST_SPACING_LOG2));
    let reach = distance / (spacing * shading.level.y);
    let morph = clamp((reach - shading.level.z) / (shading.level.w - shading.level.z), 0.0, 1.0);
    let fine = select(0.0, 1.0, wavelength_m >= SHADE_SPACINGS * spacing);
    let coarse = select(0.0, 1.0, wavelength_m >= 2.0 * SHADE_SPACINGS * spacing);
    return fine * (1.0 - morph) + coarse * morph;
}

fn terrain_surface(sample: vec4<f32>, relative: vec3<f32>) -> Surface {
    let footprint = footprint_m(relative, sample.w, vec3(0.0, 0.0, 1.0));
    var gradient = sample.xy;
    var albedo = sample.z;
    for (var k = 0u; k < shading.counts.z; k++) {
        let octave = shading.octaves[k];
        let seen = visibility(octave.row_x.w, footprint);
        if seen <= 0.0 {
            break;
        }
        let weight = seen * (1.0 - carried_by_mesh(octave.row_x.w, relative));
        if weight > 0.0 {
            let noise = octave_planar(octave, relative);
            gradient += weight * octave.row_y.w * noise.relief_gradient.xy;
            albedo += weight * octave.row_z.w * noise.albedo;
        }
    }
    let clamped = clamp(shading.surface.x * (1.0 + albedo), 0.02, 0.95);
    return Surface(relative, normalize(vec3(-sample.xy, 1.0)), normalize(vec3(-gradient, 1.0)), clamped);
}

fn body_surface(sample: vec4<f32>, relative: vec3<f32>, painted: f32) -> Surface {
    let smooth_normal = normalize(sample.xyz);
    let footprint = footprint_m(relative, sample.w, smooth_normal);
    var gradient = vec3(0.0);
    var albedo = 0.0;
    for (var k = 0u; k < shading.counts.z; k++) {
        let octave = shading.octaves[k];
        let seen = visibility(octave.row_x.w, footprint);
        if seen <= 0.0 {
            break;
        }
        let noise = octave_solid(octave, relative);
        gradient += seen * octave.row_y.w * noise.relief_gradient;
        albedo += seen * octave.row_z.w * noise.albedo;
    }
    let tangent = gradient - smooth_normal * dot(smooth_normal, gradient);
    let clamped = clamp(shading.surface.x * painted * (1.0 + albedo), 0.0, 0.95);
    return Surface(relative, smooth_normal, normalize(smooth_normal - tangent), clamped);
}

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
    if max(reach.x, reach.y) * at.z > 0.5 {
        return penumbra(receiver, reach);
    }
    var light = 0.0;
    for (var tap = 0u; tap < 4u; tap++) {
        light += lit_share(receiver, vec2(f32(tap & 1u), f32(tap >> 1u)) - 0.5);
    }
    return 0.25 * light;
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

// Share of the solar disc seen: what blocks it is taken to lie at the mean depth of the blockers around, from where the
// disc's image has a certain size (Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH sketches 2005).
fn penumbra(receiver: Receiver, reach: vec2<f32>) -> f32 {
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
        if behind > 0.0 {
            blockers += 1.0;
            gap += behind;
        }
    }
    if blockers == 0.0 {
        return 1.0;
    }
    let radius = max(reach * gap / blockers, vec2(0.75));
    var light = 0.0;
    for (var tap = 0u; tap < DISC_TAPS; tap++) {
        direction = next_on_disc(direction);
        light += lit_share(receiver, radius * direction * sqrt((f32(tap) + 0.5) / f32(DISC_TAPS)));
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

fn radiance(surface: Surface, light: f32) -> f32 {
    let to_camera = -normalize(surface.relative);
    let sun_cosine = dot(surface.normal, shading.sun.xyz);
    // Bumps cannot raise the ground beyond the terminator by more than their own slope.
    let width = max(shading.surface.z, 1e-5);
    let horizon = clamp(0.5 + 0.5 * dot(surface.smooth_normal, shading.sun.xyz) / width, 0.0, 1.0);
    var total = shading.sun.w * surface.albedo * (0.5 + 0.5 * surface.normal.z);
    if sun_cosine > 0.0 && horizon > 0.0 {
        let direct = reflectance(shading.photometry, surface.albedo, surface.normal, shading.sun.xyz, to_camera);
        total += horizon * light * direct;
    }
    return total;
}

fn mask_of(smooth_normal: vec3<f32>, light: f32) -> u32 {
    let sun_cosine = dot(smooth_normal, shading.sun.xyz);
    var mask = BODY;
    if sun_cosine > 0.0 && light > 0.5 {
        mask |= LIT;
    }
    if abs(sun_cosine) < TERMINATOR_COSINE {
        mask |= TERMINATOR;
    }
    return mask;
}

// The samples of one pixel between two depths, summed by their share of the pixel.
struct Layer {
    share: f32,
    numbers: vec3<f32>,   // normal, or gradient and albedo
    painted: f32,         // albedo over the mean that a body's mesh carries: the length of its normal
    in_camera: vec3<f32>, // m; below a convex surface, for it is a mean
    drawn: vec3<f32>,     // the sample nearest to the centre: on the surface, m
    nearest: f32,         // depths, m
    farthest: f32,
}

fn layer_of(pixel: vec2<u32>, near: f32, far: f32, is_terrain: bool) -> Layer {
    let taps = shading.counts.x;
    let stride = shading.counts.y;
    var layer = Layer(0.0, vec3(0.0), 0.0, vec3(0.0), vec3(0.0), FARTHEST, 0.0);
    var off_center = FARTHEST;
    for (var k = 0u; k < taps * taps; k++) {
        let tap = vec2(k % taps, k / taps);
        let seen = seen_between(pixel * stride + tap, near, far);
        if seen.share > 0.0 {
            let outer = (tap == vec2(0u)) | (tap == vec2(taps - 1u));
            let halves = select(vec2(1.0), vec2(0.5), outer & vec2(taps != stride));
            let share = halves.x * halves.y * seen.share;
            let depth = seen.in_camera.z;
            layer.share += share;
            let painted = select(length(seen.numbers), 1.0, is_terrain);
            layer.numbers += share / painted * seen.numbers;
            layer.painted += share * painted;
            layer.in_camera += share * seen.in_camera;
            let off = vec2<f32>(tap) - 0.5 * f32(taps - 1u);
            if dot(off, off) < off_center {
                off_center = dot(off, off);
                layer.drawn = seen.in_camera;
            }
            layer.nearest = min(layer.nearest, depth);
            layer.farthest = max(layer.farthest, depth);
        }
    }
    let inverse = 1.0 / max(layer.share, 1e-6);
    layer.numbers *= inverse;
    layer.painted *= inverse;
    layer.in_camera *= inverse;
    layer.share /= f32(stride * stride);
    return layer;
}

// Whether a pixel's samples lie on surfaces one behind the other, and not on one slope.
fn is_torn(layer: Layer, surface: Surface) -> bool {
    let cosine = max(abs(dot(normalize(surface.relative), surface.smooth_normal)), 0.05);
    let pixel_m = layer.in_camera.z / min(shading.focal.x, shading.focal.y);
    return layer.farthest - layer.nearest > pixel_m * (2.0 + 4.0 / cosine);
}

fn surface_of(layer: Layer, is_terrain: bool) -> Surface {
    let relative = relative_place(layer.in_camera);
    if is_terrain {
        return terrain_surface(vec4(layer.numbers, layer.in_camera.z), relative);
    }
    return body_surface(vec4(layer.numbers, layer.in_camera.z), relative, layer.painted);
}

fn smooth_normal_of(numbers: vec3<f32>, is_terrain: bool) -> vec3<f32> {
    return normalize(select(numbers, vec3(-numbers.xy, 1.0), is_terrain));
}

struct Shaded {
    outputs: Outputs,
    center: Surface, // at the pixel's centre, if anything is hit there
}

fn shade(target_position: vec4<f32>, is_terrain: bool) -> Shaded {
    let pixel = vec2<u32>(target_position.xy);
    var out: Shaded;
    let center_at = pixel * shading.counts.y + shading.counts.x / 2u;
    let center = seen_at_center(center_at);
    let center_depth = select(0.0, center.in_camera.z, center.share > 0.0);
    out.outputs.depth = center_depth;
    let all = layer_of(pixel, 0.0, FARTHEST, is_terrain);
    if all.share <= 0.0 {
        return out;
    }
    out.center = surface_of(all, is_terrain);
    var light = 0.0;
    if is_torn(all, out.center) {
        let middle = 0.5 * (all.nearest + all.farthest);
        let front = layer_of(pixel, 0.0, middle, is_terrain);
        let back = layer_of(pixel, middle, FARTHEST, is_terrain);
        let front_surface = surface_of(front, is_terrain);
        let back_surface = surface_of(back, is_terrain);
        let front_light = sunlight(relative_place(front.drawn), front_surface.smooth_normal);
        let back_light = sunlight(relative_place(back.drawn), back_surface.smooth_normal);
        out.outputs.radiance =
            front.share * radiance(front_surface, front_light) + back.share * radiance(back_surface, back_light);
        light = front_light;
        out.center = front_surface;
        if center_depth > middle {
            light = back_light;
            out.center = back_surface;
        }
    } else {
        light = sunlight(relative_place(all.drawn), drawn_normal(center_at, out.center.smooth_normal));
        out.outputs.radiance = all.share * radiance(out.center, light);
    }
    if center_depth > 0.0 {
        out.outputs.mask = mask_of(smooth_normal_of(center.numbers, is_terrain), light);
    }
    return out;
}

@fragment
fn terrain(@builtin(position) position: vec4<f32>) -> Outputs {
    return shade(position, true).outputs;
}

@fragment
fn body(@builtin(position) position: vec4<f32>) -> Outputs {
    return shade(position, false).outputs;
}

struct OutputsWithSurface {
    @location(0) radiance: f32,
    @location(1) depth: f32,
    @location(2) mask: u32,
    @location(3) surface: vec4<f32>, // normal in reference axes, albedo
}

fn with_surface(shaded: Shaded) -> OutputsWithSurface {
    let out = shaded.outputs;
    return OutputsWithSurface(out.radiance, out.depth, out.mask, vec4(shaded.center.normal, shaded.center.albedo));
}

@fragment
fn terrain_with_surface(@builtin(position) position: vec4<f32>) -> OutputsWithSurface {
    return with_surface(shade(position, true));
}

@fragment
fn body_with_surface(@builtin(position) position: vec4<f32>) -> OutputsWithSurface {
    return with_surface(shade(position, false));
}
