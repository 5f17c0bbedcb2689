// From surface samples to radiance, depth and mask: photometry, cast shadows, and detail below the mesh's resolution.
// One module with shaders/noise.wgsl, photometry.wgsl, lens.wgsl and shadow.wgsl.
//
// A software adapter runs both sides of a branch for all pixels, and every loop once more than its condition at the top holds:
// what a pipeline does not need is left out by an override, loops have their condition at the end, and what happens for one
// or two layers stands in one loop.

struct Shading {
    reference_from_camera: mat4x4<f32>, // rotation
    shadow_from_relative: mat4x4<f32>,  // relative = reference axes, camera at the origin, m
    sun: vec4<f32>,       // direction in reference axes; w = radiance of the sky over that of a sunlit white surface
    focal: vec4<f32>,     // focal lengths of the camera in px
    raster: vec4<f32>,    // focal lengths and principal point of the pinhole picture in samples
    surface: vec4<f32>,   // mean albedo, r.m.s. slope of the detail, z of the highest ground from the camera m
    shadow: vec4<f32>,    // texel's width and height in m, depth of the map in m, tangent of the Sun's radius
    level: vec4<f32>,     // terrain: height above ground m, range over spacing, morph start, morph end
    photometry: Photometry,
    octaves: array<Octave, OCTAVES>,
}

@group(0) @binding(0) var<uniform> shading: Shading;
@group(0) @binding(1) var samples: texture_2d<f32>;

// Samples a pixel and axis.
override STRIDE: u32 = 1u;
// Samples along each side of a pixel's square: odd, so that the middle one is the pixel's centre.
override TAPS: u32 = 1u;
// Whether the surface is terrain: samples are gradients and albedos; or a body: samples are normals.
override TERRAIN: bool = false;
// Octaves of terrain that are evaluated without a loop, which then are all there are; 0 for a loop.
override ONE_BY_ONE: u32 = 0u;

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
const FARTHEST: f32 = 3.0e38; // m
const FINEST_SPACING_LOG2: f32 = -8.0;
const SHADE_SPACINGS: f32 = 8.0; // as in src/render/terrain_tile.rs
const CARRIED_SPACINGS: f32 = 16.0; // vertices carry octaves from here on, slid or not

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32((index << 1u) & 2u) * 2.0 - 1.0, f32(index & 2u) * 2.0 - 1.0, 0.5, 1.0);
}

fn relative_place(in_camera: vec3<f32>) -> vec3<f32> {
    return (shading.reference_from_camera * vec4(in_camera, 0.0)).xyz;
}

fn footprint_m(relative: vec3<f32>, depth: f32, normal: vec3<f32>) -> f32 {
    let cosine = abs(dot(normalize(relative), normal));
    return depth * inverseSqrt(shading.focal.x * shading.focal.y * max(cosine, 0.1));
}

// How fine the terrain's mesh is at a place: spacing of vertices in m, and how far they have slid onto the coarser grid.
struct Mesh {
    spacing: f32,
    morph: f32,
}

fn mesh_at(relative: vec3<f32>) -> Mesh {
    let distance = sqrt(dot(relative.xy, relative.xy) + shading.level.x * shading.level.x);
    let spacing = exp2(max(ceil(log2(distance / shading.level.y)), FINEST_SPACING_LOG2));
    let reach = distance / (spacing * shading.level.y);
    return Mesh(spacing, clamp((reach - shading.level.z) / (shading.level.w - shading.level.z), 0.0, 1.0));
}

// Share of an octave that the vertices of the mesh already carry.
fn carried_by(mesh: Mesh, wavelength_m: f32) -> f32 {
    let fine = step(SHADE_SPACINGS * mesh.spacing, wavelength_m);
    let coarse = step(2.0 * SHADE_SPACINGS * mesh.spacing, wavelength_m);
    return fine * (1.0 - mesh.morph) + coarse * mesh.morph;
}

// The first octave with a wavelength below one in m: wavelengths halve from octave to octave.
fn first_below(wavelength_m: f32) -> u32 {
    let halvings = log2(shading.octaves[0].row_x.w / wavelength_m);
    return u32(clamp(floor(halvings - 1e-3) + 1.0, 0.0, f32(OCTAVES - 1u)));
}

// Whether no octave from one on shows in a picture. Those behind the last one have no wavelength.
fn shows_none_from(octave: u32, footprint: f32) -> bool {
    return octave >= OCTAVES || shading.octaves[min(octave, OCTAVES - 1u)].row_x.w <= footprint;
}

// What an octave adds to gradient and albedo of terrain.
fn planar_detail(octave: Octave, relative: vec3<f32>, footprint: f32, mesh: Mesh) -> vec3<f32> {
    let weight = visibility(octave.row_x.w, footprint) * (1.0 - carried_by(mesh, octave.row_x.w));
    let noise = octave_planar(octave, relative);
    return weight * vec3(octave.row_y.w * noise.relief_gradient.xy, octave.row_z.w * noise.albedo);
}

// The first octaves of the table, ONE_BY_ONE of them.
fn octaves_one_by_one(relative: vec3<f32>, footprint: f32, mesh: Mesh) -> vec3<f32> {
    var detail = vec3(0.0);
    if ONE_BY_ONE > 0u {
        detail += planar_detail(shading.octaves[0], relative, footprint, mesh);
    }
    if ONE_BY_ONE > 1u {
        detail += planar_detail(shading.octaves[1], relative, footprint, mesh);
    }
    if ONE_BY_ONE > 2u {
        detail += planar_detail(shading.octaves[2], relative, footprint, mesh);
    }
    if ONE_BY_ONE > 3u {
        detail += planar_detail(shading.octaves[3], relative, footprint, mesh);
    }
    if ONE_BY_ONE > 4u {
        detail += planar_detail(shading.octaves[4], relative, footprint, mesh);
    }
    if ONE_BY_ONE > 5u {
        detail += planar_detail(shading.octaves[5], relative, footprint, mesh);
    }
    return detail;
}

// All octaves of the table that show.
fn octaves_in_turn(relative: vec3<f32>, footprint: f32, mesh: Mesh) -> vec3<f32> {
    var detail = vec3(0.0);
    // Vertices that have not slid carry twice as many octaves.
    var k = first_below(select(CARRIED_SPACINGS, SHADE_SPACINGS, mesh.morph == 0.0) * mesh.spacing);
    loop {
        detail += planar_detail(shading.octaves[k], relative, footprint, mesh);
        k++;
        if shows_none_from(k, footprint) {
            break;
        }
    }
    return detail;
}

fn terrain_surface(sample: vec4<f32>, relative: vec3<f32>) -> Surface {
    let footprint = footprint_m(relative, sample.w, vec3(0.0, 0.0, 1.0));
    let mesh = mesh_at(relative);
    var detail = sample.xyz;
    if ONE_BY_ONE > 0u {
        detail += octaves_one_by_one(relative, footprint, mesh);
    } else {
        detail += octaves_in_turn(relative, footprint, mesh);
    }
    let clamped = clamp(shading.surface.x * (1.0 + detail.z), 0.02, 0.95);
    return Surface(relative, normalize(vec3(-sample.xy, 1.0)), normalize(vec3(-detail.xy, 1.0)), clamped);
}

fn body_surface(sample: vec4<f32>, relative: vec3<f32>, painted: f32) -> Surface {
    let smooth_normal = normalize(sample.xyz);
    let footprint = footprint_m(relative, sample.w, smooth_normal);
    var gradient = vec3(0.0);
    var albedo = 0.0;
    var k = 0u;
    loop {
        let octave = shading.octaves[k];
        let weight = visibility(octave.row_x.w, footprint);
        let noise = octave_solid(octave, relative);
        gradient += weight * octave.row_y.w * noise.relief_gradient;
        albedo += weight * octave.row_z.w * noise.albedo;
        k++;
        if shows_none_from(k, footprint) {
            break;
        }
    }
    let tangent = gradient - smooth_normal * dot(smooth_normal, gradient);
    let clamped = clamp(shading.surface.x * painted * (1.0 + albedo), 0.0, 0.95);
    return Surface(relative, smooth_normal, normalize(smooth_normal - tangent), clamped);
}

fn radiance(surface: Surface, light: f32) -> f32 {
    let to_camera = -normalize(surface.relative);
    let sun_cosine = dot(surface.normal, shading.sun.xyz);
    // Bumps cannot raise the ground beyond the terminator by more than their own slope.
    let width = max(shading.surface.y, 1e-5);
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
    share: f32,           // of the pixel
    weight: f32,          // of the means below
    numbers: vec3<f32>,   // normal, or gradient and albedo
    painted: f32,         // albedo over the mean that a body's mesh carries: the length of its normal
    in_camera: vec3<f32>, // m; below a convex surface, for it is a mean
    drawn: vec3<f32>,     // the sample nearest to the centre: on the surface, m
    nearest: f32,         // depths, m
    farthest: f32,
}

//
// Where samples lie on the pixel's border, borders count half in the share (the trapezoidal rule). For the means they count
// 1/2 - 1/(2 stride), so that the means are also those of quadratic functions (Simpson's rule at a stride of 2).
fn layer_of(pixel: vec2<u32>, near: f32, far: f32) -> Layer {
    let border = 0.5 - 0.5 / f32(STRIDE);
    var layer = Layer(0.0, 0.0, vec3(0.0), 0.0, vec3(0.0), vec3(0.0), FARTHEST, 0.0);
    var off_center = FARTHEST;
    for (var k = 0u; k < TAPS * TAPS; k++) {
        let tap = vec2(k % TAPS, k / TAPS);
        let seen = seen_between(pixel * STRIDE + tap, near, far);
        if seen.share > 0.0 {
            let outer = (tap == vec2(0u)) | (tap == vec2(TAPS - 1u));
            let on_border = outer & vec2(TAPS != STRIDE);
            let halves = select(vec2(1.0), vec2(0.5), on_border);
            let parts = select(vec2(1.0), vec2(border), on_border);
            let weight = parts.x * parts.y * seen.share;
            let depth = seen.in_camera.z;
            layer.share += halves.x * halves.y * seen.share;
            layer.weight += weight;
            let painted = select(length(seen.numbers), 1.0, TERRAIN);
            layer.numbers += weight / painted * seen.numbers;
            layer.painted += weight * painted;
            layer.in_camera += weight * seen.in_camera;
            let off = vec2<f32>(tap) - 0.5 * f32(TAPS - 1u);
            if dot(off, off) < off_center {
                off_center = dot(off, off);
                layer.drawn = seen.in_camera;
            }
            layer.nearest = min(layer.nearest, depth);
            layer.farthest = max(layer.farthest, depth);
        }
    }
    let inverse = 1.0 / max(layer.weight, 1e-6);
    layer.numbers *= inverse;
    layer.painted *= inverse;
    layer.in_camera *= inverse;
    layer.share /= f32(STRIDE * STRIDE);
    return layer;
}

// Whether a pixel's samples lie on surfaces one behind the other, and not on one slope.
fn is_torn(layer: Layer) -> bool {
    let toward = normalize(relative_place(layer.in_camera));
    let cosine = max(abs(dot(toward, smooth_normal_of(layer.numbers))), 0.05);
    let pixel_m = layer.in_camera.z / min(shading.focal.x, shading.focal.y);
    return layer.farthest - layer.nearest > pixel_m * (2.0 + 4.0 / cosine);
}

fn surface_of(layer: Layer) -> Surface {
    let relative = relative_place(layer.in_camera);
    if TERRAIN {
        return terrain_surface(vec4(layer.numbers, layer.in_camera.z), relative);
    }
    return body_surface(vec4(layer.numbers, layer.in_camera.z), relative, layer.painted);
}

fn smooth_normal_of(numbers: vec3<f32>) -> vec3<f32> {
    return normalize(select(numbers, vec3(-numbers.xy, 1.0), TERRAIN));
}

struct Shaded {
    outputs: Outputs,
    center: Surface, // at the pixel's centre, if anything is hit there
}

fn shade(target_position: vec4<f32>) -> Shaded {
    let pixel = vec2<u32>(target_position.xy);
    let center_at = pixel * STRIDE + TAPS / 2u;
    let center = seen_at_center(center_at);
    var out: Shaded;
    out.outputs.depth = select(0.0, center.in_camera.z, center.share > 0.0);
    let all = layer_of(pixel, 0.0, FARTHEST);
    let torn = TAPS > 1u && is_torn(all);
    let middle = select(FARTHEST, 0.5 * (all.nearest + all.farthest), torn);
    var light = 0.0;
    var k = 0u;
    loop {
        var layer = all;
        if torn {
            layer = layer_of(pixel, select(middle, 0.0, k == 0u), select(FARTHEST, middle, k == 0u));
        }
        if layer.share > 0.0 {
            let surface = surface_of(layer);
            var plane = surface.smooth_normal;
            if !torn {
                plane = drawn_normal(center_at, plane);
            }
            let seen = sunlight(relative_place(layer.drawn), plane);
            out.outputs.radiance += layer.share * radiance(surface, seen);
            if (k == 0u) == (out.outputs.depth <= middle) {
                light = seen;
                out.center = surface;
            }
        }
        k++;
        if !torn || k == 2u {
            break;
        }
    }
    if out.outputs.depth > 0.0 {
        out.outputs.mask = mask_of(smooth_normal_of(center.numbers), light);
    }
    return out;
}

@fragment
fn picture(@builtin(position) position: vec4<f32>) -> Outputs {
    return shade(position).outputs;
}

struct OutputsWithSurface {
    @location(0) radiance: f32,
    @location(1) depth: f32,
    @location(2) mask: u32,
    @location(3) surface: vec4<f32>, // normal in reference axes, albedo
}

@fragment
fn picture_with_surface(@builtin(position) position: vec4<f32>) -> OutputsWithSurface {
    let shaded = shade(position);
    let out = shaded.outputs;
    return OutputsWithSurface(out.radiance, out.depth, out.mask, vec4(shaded.center.normal, shaded.center.albedo));
}
