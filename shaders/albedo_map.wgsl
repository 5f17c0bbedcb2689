// A small body with albedo painted on its mesh: surface normal times albedo over the mean, and depth of each sample.
// Follows shaders/body_geometry.wgsl in one module; src/scene/body/mesh_albedo.rs is its twin.

struct AlbedoMap {
    origin: vec4<f32>, // of longitudes and latitudes in the asteroid frame, m; w = east longitude of the left edge, rad
    counts: vec4<u32>, // kind, whether the picture repeats downwards, levels of the pyramid
}

@group(0) @binding(1) var<uniform> albedo_map: AlbedoMap;
@group(0) @binding(2) var albedo_picture: texture_2d<f32>;

const TEXTURE: u32 = 1u;
const GLOBE: u32 = 2u;
const PI: f32 = 3.14159265;
const LEAST_ALBEDO: f32 = 1.0e-4; // the length of a normal must not vanish

struct Painted {
    @builtin(position) clip: vec4<f32>,
    @location(0) sample: vec4<f32>,      // normal, and depth m
    @location(1) paint: vec2<f32>,       // texture coordinates, or the vertex's albedo
    @location(2) from_origin: vec3<f32>, // m
}

@vertex
fn painted_vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) paint: vec2<f32>,
) -> Painted {
    let plain = placed(position, normal);
    return Painted(plain.clip, plain.sample, paint, position - albedo_map.origin.xyz);
}

@fragment
fn painted_fragment(in: Painted) -> @location(0) vec4<f32> {
    var albedo = in.paint.x;
    if albedo_map.counts.x == TEXTURE {
        albedo = picture_at(vec2(in.paint.x, 1.0 - in.paint.y));
    } else if albedo_map.counts.x == GLOBE {
        let d = in.from_origin;
        let east = atan2(d.y, d.x) - albedo_map.origin.w;
        albedo = picture_at(vec2(east / (2.0 * PI), 0.5 - atan2(d.z, length(d.xy)) / PI));
    }
    return vec4(normalize(in.sample.xyz) * max(albedo, LEAST_ALBEDO), in.sample.w);
}

// Value at a place, (0, 0) the upper left corner of the picture and (1, 1) the lower right one: bilinear where a sample is
// smaller than a pixel of the picture, else between the two levels of the pyramid around its size.
fn picture_at(place: vec2<f32>) -> f32 {
    let along_x = dpdx(place);
    let along_y = dpdy(place);
    // A map's longitude jumps by a turn at one meridian.
    let size = vec2<f32>(textureDimensions(albedo_picture, 0));
    let across = max(length((along_x - round(along_x)) * size), length((along_y - round(along_y)) * size));
    // Beside a face at the limb the differences may be no numbers at all: the picture's mean serves there.
    let coarsest = f32(albedo_map.counts.z - 1u);
    var level = coarsest;
    if across < 65536.0 {
        level = clamp(log2(max(across, 1.0)), 0.0, coarsest);
    }
    let fine = i32(level);
    let coarse = min(fine + 1, i32(albedo_map.counts.z) - 1);
    return mix(bilinear(place, fine), bilinear(place, coarse), fract(level));
}

fn bilinear(place: vec2<f32>, level: i32) -> f32 {
    let at = place * vec2<f32>(size_of(level)) - 0.5;
    let low = floor(at);
    let share = at - low;
    let i = vec2<i32>(low);
    let upper = mix(texel(i, level), texel(i + vec2(1, 0), level), share.x);
    let lower = mix(texel(i + vec2(0, 1), level), texel(i + vec2(1, 1), level), share.x);
    return mix(upper, lower, share.y);
}

// Size of a level of the pyramid. Some drivers answer a query for one sample's level for its neighbours' levels too.
fn size_of(level: i32) -> vec2<i32> {
    return max(vec2<i32>(textureDimensions(albedo_picture, 0)) >> vec2(u32(level)), vec2(1));
}

fn texel(at: vec2<i32>, level: i32) -> f32 {
    let size = size_of(level);
    let around = ((at % size) + size) % size;
    let row = select(clamp(at.y, 0, size.y - 1), around.y, albedo_map.counts.y == 1u);
    return textureLoad(albedo_picture, vec2(around.x, row), level).x;
}
