// From surface samples to radiance, depth and mask: photometry, cast shadows, and detail below the mesh's resolution.
// Follows shaders/noise.wgsl and shaders/photometry.wgsl in one module.

struct Shading {
    reference_from_camera: mat4x4<f32>, // rotation
    shadow_from_relative: mat4x4<f32>,  // relative = reference axes, camera at the origin, m
    sun: vec4<f32>,       // direction in reference axes; w = radiance of the sky over that of a sunlit white surface
    intrinsics: vec4<f32>, // fu, fv, cu, cv in px
    surface: vec4<f32>,   // mean albedo, unused, r.m.s. slope of the detail, shadow texel in m
    level: vec4<f32>,     // terrain: height above ground m, range over spacing, morph start, morph end
    counts: vec4<u32>,    // supersampling, octaves
    photometry: Photometry,
    octaves: array<Octave, OCTAVES>,
}

@group(0) @binding(0) var<uniform> shading: Shading;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var truth: texture_2d<f32>;
@group(0) @binding(3) var shadow_map: texture_depth_2d;
@group(0) @binding(4) var shadow_sampler: sampler_comparison;

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

// The only place where a sample of a target becomes a pixel coordinate: sample centres lie at +0.5 in the target, and
// the centre of the top-left pixel is (0, 0).
fn pixel_from_sample(sample: vec2<u32>, supersampling: u32) -> vec2<f32> {
    return (vec2<f32>(sample) + 0.5) / f32(supersampling) - 0.5;
}

fn relative_place(pixel: vec2<f32>, depth: f32) -> vec3<f32> {
    let ideal = (pixel - shading.intrinsics.zw) / shading.intrinsics.xy;
    return (shading.reference_from_camera * vec4(ideal * depth, depth, 0.0)).xyz;
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
    for (var k = 0u; k < shading.counts.y; k++) {
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
    for (var k = 0u; k < shading.counts.y; k++) {
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

// Share of the Sun seen, 0 to 1, of a place lifted off the surface against shadowing by itself: the filter reaches 1.5
// texels on both axes, over which a plane falls away by up to 2.2 texels times the sine of the incidence.
fn sunlight(surface: Surface) -> f32 {
    let cosine = clamp(dot(surface.smooth_normal, shading.sun.xyz), 0.0, 1.0);
    let lift_m = shading.surface.w * (0.5 + 2.2 * sqrt(1.0 - cosine * cosine));
    let lifted = surface.relative + surface.smooth_normal * lift_m;
    let at = (shading.shadow_from_relative * vec4(lifted, 1.0)).xyz;
    if any(at.xy < vec2(0.0)) || any(at.xy > vec2(1.0)) {
        return 1.0;
    }
    let texel = 0.5 / vec2<f32>(textureDimensions(shadow_map));
    var light = 0.0;
    for (var tap = 0u; tap < 4u; tap++) {
        let shift = (vec2(f32(tap & 1u), f32(tap >> 1u)) * 2.0 - 1.0) * texel;
        light += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + shift, at.z);
    }
    return 0.25 * light;
}

fn radiance(surface: Surface) -> f32 {
    let to_camera = -normalize(surface.relative);
    let sun_cosine = dot(surface.normal, shading.sun.xyz);
    // Bumps cannot raise the ground beyond the terminator by more than their own slope.
    let width = max(shading.surface.z, 1e-5);
    let horizon = clamp(0.5 + 0.5 * dot(surface.smooth_normal, shading.sun.xyz) / width, 0.0, 1.0);
    var total = shading.sun.w * surface.albedo * (0.5 + 0.5 * surface.normal.z);
    if sun_cosine > 0.0 && horizon > 0.0 {
        let direct = reflectance(shading.photometry, surface.albedo, surface.normal, shading.sun.xyz, to_camera);
        total += horizon * sunlight(surface) * direct;
    }
    return total;
}

fn mask_of(surface: Surface) -> u32 {
    let sun_cosine = dot(surface.smooth_normal, shading.sun.xyz);
    var mask = BODY;
    if sun_cosine > 0.0 && sunlight(surface) > 0.5 {
        mask |= LIT;
    }
    if abs(sun_cosine) < TERMINATOR_COSINE {
        mask |= TERMINATOR;
    }
    return mask;
}

fn surface_of(sample: vec4<f32>, pixel: vec2<f32>, is_terrain: bool) -> Surface {
    let relative = relative_place(pixel, sample.w);
    if is_terrain {
        return terrain_surface(sample, relative);
    }
    return body_surface(sample, relative);
}

// The surface as its mesh has it.
fn smooth_surface_of(sample: vec4<f32>, pixel: vec2<f32>, is_terrain: bool) -> Surface {
    let normal = normalize(select(sample.xyz, vec3(-sample.xy, 1.0), is_terrain));
    return Surface(relative_place(pixel, sample.w), normal, normal, shading.surface.x);
}

fn shade(target_position: vec4<f32>, is_terrain: bool) -> Outputs {
    let at = vec2<u32>(target_position.xy);
    let supersampling = shading.counts.x;
    var out = Outputs(0.0, 0.0, 0u);
    for (var k = 0u; k < supersampling * supersampling; k++) {
        let sample_at = at * supersampling + vec2(k % supersampling, k / supersampling);
        let sample = textureLoad(picture, sample_at, 0);
        if sample.w > 0.0 {
            out.radiance += radiance(surface_of(sample, pixel_from_sample(sample_at, supersampling), is_terrain));
        }
    }
    out.radiance /= f32(supersampling * supersampling);
    let center = textureLoad(truth, at, 0);
    out.depth = center.w;
    if center.w > 0.0 {
        out.mask = mask_of(smooth_surface_of(center, pixel_from_sample(at, 1u), is_terrain));
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
