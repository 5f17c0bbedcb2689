// From surface samples to radiance, depth and mask: photometry, cast shadows, and detail below the mesh's resolution.
// Follows shaders/noise.wgsl and shaders/photometry.wgsl in one module.

struct Shading {
    reference_from_camera: mat4x4<f32>, // rotation
    shadow_from_relative: mat4x4<f32>,  // relative = reference axes, camera at the origin, m
    sun: vec4<f32>,       // direction in reference axes; w = radiance of the sky over that of a sunlit white surface
    intrinsics: vec4<f32>, // fu, fv, cu, cv in px
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
const FINEST_SPACING_LOG2: f32 = -8.0;
const SHADE_SPACINGS: f32 = 16.0; // as in src/render/terrain_tile.rs

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32((index << 1u) & 2u) * 2.0 - 1.0, f32(index & 2u) * 2.0 - 1.0, 0.5, 1.0);
}

// The only place where a sample of the target becomes a pixel coordinate; the centre of the top-left pixel is (0, 0).
// See src/render/sample_grid.rs.
fn pixel_from_sample(at: vec2<u32>) -> vec2<f32> {
    let shift = select(0.0, 0.5, shading.counts.x == shading.counts.y);
    return (vec2<f32>(at) + shift) / f32(shading.counts.y) - 0.5;
}

fn place_in_camera(at: vec2<u32>, depth: f32) -> vec3<f32> {
    let ideal = (pixel_from_sample(at) - shading.intrinsics.zw) / shading.intrinsics.xy;
    return vec3(ideal * depth, depth);
}

fn relative_place(in_camera: vec3<f32>) -> vec3<f32> {
    return (shading.reference_from_camera * vec4(in_camera, 0.0)).xyz;
}

fn footprint_m(relative: vec3<f32>, depth: f32, normal: vec3<f32>) -> f32 {
    let cosine = abs(dot(normalize(relative), normal));
    return depth * inverseSqrt(shading.intrinsics.x * shading.intrinsics.y * max(cosine, 0.1));
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

fn body_surface(sample: vec4<f32>, relative: vec3<f32>) -> Surface {
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
    let clamped = clamp(shading.surface.x * (1.0 + albedo), 0.005, 0.95);
    return Surface(relative, smooth_normal, normalize(smooth_normal - tangent), clamped);
}

// Share of the Sun seen by a place, 0 to 1. Texels are compared with the plane through the place, so that a slope does
// not shadow itself (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006); what the plane misses of a
// curved surface is covered by a lift of a part of a texel.
fn sunlight(surface: Surface) -> f32 {
    let facing = dot(surface.smooth_normal, shading.sun.xyz);
    let cosine = clamp(facing, 0.02, 1.0);
    let lift_m = max(shading.shadow.x, shading.shadow.y) * (0.4 + 0.4 / max(cosine, 0.2));
    let lifted = surface.relative + surface.smooth_normal * lift_m;
    let at = (shading.shadow_from_relative * vec4(lifted, 1.0)).xyz;
    if any(at.xy < vec2(0.0)) || any(at.xy > vec2(1.0)) {
        return 1.0;
    }
    let m = transpose(shading.shadow_from_relative);
    let across = vec3(
        dot(m[0].xyz, surface.smooth_normal) / dot(m[0].xyz, m[0].xyz),
        dot(m[1].xyz, surface.smooth_normal) / dot(m[1].xyz, m[1].xyz),
        -cosine / length(m[2].xyz),
    );
    let size = vec2<f32>(textureDimensions(shadow_map));
    let slope = -across.xy / across.z / size; // change of depth a texel
    var light = 0.0;
    for (var tap = 0u; tap < 4u; tap++) {
        let shift = vec2(f32(tap & 1u), f32(tap >> 1u)) - 0.5;
        light += lit_share(at.xy * size, at.xy * size + shift, at.z, slope);
    }
    return 0.25 * light;
}

// Share of the four texels around `tap` (in texels) that let light through to a plane through `place` at `depth`.
fn lit_share(place: vec2<f32>, tap: vec2<f32>, depth: f32, slope: vec2<f32>) -> f32 {
    let low = floor(tap - 0.5);
    let share = tap - 0.5 - low;
    let blockers = textureGather(shadow_map, shadow_sampler, (low + 1.0) / vec2<f32>(textureDimensions(shadow_map)));
    let first = depth + dot(slope, low + 0.5 - place);
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
    numbers: vec3<f32>,   // normal or gradient, and albedo
    in_camera: vec3<f32>, // m
    nearest: f32,         // depths, m
    farthest: f32,
}

fn layer_of(pixel: vec2<u32>, near: f32, far: f32) -> Layer {
    let taps = shading.counts.x;
    let stride = shading.counts.y;
    var layer = Layer(0.0, vec3(0.0), vec3(0.0), 3.0e38, 0.0);
    for (var k = 0u; k < taps * taps; k++) {
        let tap = vec2(k % taps, k / taps);
        let at = pixel * stride + tap;
        let sample = textureLoad(samples, at, 0);
        if sample.w > near && sample.w <= far {
            let outer = (tap == vec2(0u)) | (tap == vec2(taps - 1u));
            let halves = select(vec2(1.0), vec2(0.5), outer & vec2(taps != stride));
            let share = halves.x * halves.y;
            layer.share += share;
            layer.numbers += share * sample.xyz;
            layer.in_camera += share * place_in_camera(at, sample.w);
            layer.nearest = min(layer.nearest, sample.w);
            layer.farthest = max(layer.farthest, sample.w);
        }
    }
    let inverse = 1.0 / max(layer.share, 1e-6);
    layer.numbers *= inverse;
    layer.in_camera *= inverse;
    layer.share /= f32(stride * stride);
    return layer;
}

// Whether a pixel's samples lie on surfaces one behind the other, and not on one slope.
fn is_torn(layer: Layer, surface: Surface) -> bool {
    let cosine = max(abs(dot(normalize(surface.relative), surface.smooth_normal)), 0.05);
    let pixel_m = layer.in_camera.z / min(shading.intrinsics.x, shading.intrinsics.y);
    return layer.farthest - layer.nearest > pixel_m * (2.0 + 4.0 / cosine);
}

fn surface_of(layer: Layer, is_terrain: bool) -> Surface {
    let relative = relative_place(layer.in_camera);
    if is_terrain {
        return terrain_surface(vec4(layer.numbers, layer.in_camera.z), relative);
    }
    return body_surface(vec4(layer.numbers, layer.in_camera.z), relative);
}

fn smooth_normal_of(sample: vec4<f32>, is_terrain: bool) -> vec3<f32> {
    return normalize(select(sample.xyz, vec3(-sample.xy, 1.0), is_terrain));
}

fn shade(target_position: vec4<f32>, is_terrain: bool) -> Outputs {
    let pixel = vec2<u32>(target_position.xy);
    var out = Outputs(0.0, 0.0, 0u);
    let center_at = pixel * shading.counts.y + shading.counts.x / 2u;
    let center = textureLoad(samples, center_at, 0);
    out.depth = center.w;
    let all = layer_of(pixel, 0.0, 3.0e38);
    if all.share <= 0.0 {
        return out;
    }
    let surface = surface_of(all, is_terrain);
    var light = 0.0;
    if is_torn(all, surface) {
        let middle = 0.5 * (all.nearest + all.farthest);
        let front = layer_of(pixel, 0.0, middle);
        let back = layer_of(pixel, middle, 3.0e38);
        let front_surface = surface_of(front, is_terrain);
        let back_surface = surface_of(back, is_terrain);
        let front_light = sunlight(front_surface);
        let back_light = sunlight(back_surface);
        light = select(front_light, back_light, center.w > middle);
        out.radiance = front.share * radiance(front_surface, front_light) + back.share * radiance(back_surface, back_light);
    } else {
        light = sunlight(surface);
        out.radiance = all.share * radiance(surface, light);
    }
    if center.w > 0.0 {
        out.mask = mask_of(smooth_normal_of(center, is_terrain), light);
    }
    return out;
}

@fragment
fn terrain(@builtin(position) position: vec4<f32>) -> Outputs {
    return shade(position, true);
}

@fragment
fn body(@builtin(position) position: vec4<f32>) -> Outputs {
    return shade(position, false);
}
