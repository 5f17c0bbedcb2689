// Terrain tiles: 33 by 33 vertices each, pulled from a pool of tiles; and rocks on them, pulled from pages of one tile each. Vertices far out in their level's range slide onto
// the grid of the next coarser level, so that levels join without cracks and nothing pops.

struct Geometry {
    clip_from_relative: mat4x4<f32>, // relative = reference axes, camera at the origin, m
    forward: vec4<f32>,              // optical axis in reference axes
    camera_high: vec4<f32>,          // camera position, from the anchor in x and y
    camera_low: vec4<f32>,           // what f32 dropped of it
    level: vec4<f32>,                // x = height above ground m, y = range over spacing, z = morph start, w = morph end
}

struct Tile {
    base: vec2<f32>, // corner of the tile from the anchor, m; exact
    spacing: f32,    // of vertices, m
    slot: u32,       // in the pool; unused for a page of rocks
}

@group(0) @binding(0) var<uniform> geometry: Geometry;
@group(0) @binding(1) var<storage, read> tiles: array<Tile>; // or the tiles of pages
@group(0) @binding(2) var<storage, read> pool: array<vec4<f32>>; // height m, gradient x, gradient y, change of albedo

const SIDE: u32 = 33u;
const COARSE_SIDE: u32 = 17u;
const PAGE: u32 = 256u;
const TILE_VERTICES: u32 = 1378u; // 33 * 33 fine ones, then 17 * 17 as the next coarser level has them

// A vertex slid to where its level's range says.
struct Placed {
    relative: vec3<f32>, // reference axes, camera at the origin, m
    ground: vec3<f32>,   // gradient x, gradient y, change of albedo
}

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) sample: vec4<f32>, // ground, and depth m
}

// How far a vertex of a level has slid onto the coarser one: not at all (0) or wholly (1).
fn morph_at(place: vec2<f32>, spacing: f32) -> f32 {
    let away = place - geometry.camera_high.xy - geometry.camera_low.xy;
    let distance = sqrt(dot(away, away) + geometry.level.x * geometry.level.x);
    let reach = distance / (spacing * geometry.level.y);
    return clamp((reach - geometry.level.z) / (geometry.level.w - geometry.level.z), 0.0, 1.0);
}

fn placed(index: u32, instance: u32) -> Placed {
    let tile = tiles[instance];
    let at = vec2(index % SIDE, index / SIDE);
    let even = at & vec2(~1u);
    let first = tile.slot * TILE_VERTICES;
    let fine = pool[first + index];
    let fine_even = pool[first + even.y * SIDE + even.x];
    let coarse = pool[first + SIDE * SIDE + (even.y / 2u) * COARSE_SIDE + even.x / 2u];

    let fine_place = tile.base + vec2<f32>(at) * tile.spacing;
    let coarse_place = tile.base + vec2<f32>(even) * tile.spacing;
    let morph = morph_at(fine_place, tile.spacing);

    // Written out, for mix() may round differently at 1, and shared vertices have to agree bit for bit.
    let place = fine_place * (1.0 - morph) + coarse_place * morph;
    // Shaded by the fine ground where the vertex has slid to, on the edge of a triangle between two of its vertices: octaves
    // that the coarser level leaves to shading have to be where shading adds them. Heights fit better the sooner they change.
    let shown = fine.yzw * (1.0 - morph) + fine_even.yzw * morph;
    let ground = vec4(fine.x, shown) * (1.0 - morph) + coarse * morph;
    let relative = (vec3(place, ground.x) - geometry.camera_high.xyz) - geometry.camera_low.xyz;
    return Placed(relative, ground.yzw);
}

// A vertex of a rock: the ground of the tile's level and of the coarser one below it, what the rock adds, and its place
// (src/render/terrain_rocks.rs). Rocks that the coarser level does not show sink as their tile slides onto it.
fn placed_on_rock(index: u32) -> Placed {
    let page = tiles[index / PAGE];
    let fine = pool[4u * index];
    let coarse = pool[4u * index + 1u];
    let rock = pool[4u * index + 2u];
    let local = pool[4u * index + 3u];
    let place = page.base + local.xy;
    let morph = morph_at(place, page.spacing);
    let total = mix(fine, coarse, morph) + rock * (1.0 - morph * local.z);
    let relative = (vec3(place, total.x - local.w) - geometry.camera_high.xyz) - geometry.camera_low.xyz;
    return Placed(relative, total.yzw);
}

fn outputs_of(found: Placed) -> Varying {
    let clip = geometry.clip_from_relative * vec4(found.relative, 1.0);
    return Varying(clip, vec4(found.ground, dot(geometry.forward.xyz, found.relative)));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Varying {
    return outputs_of(placed(index, instance));
}

@vertex
fn rock_vertex(@builtin(vertex_index) index: u32) -> Varying {
    return outputs_of(placed_on_rock(index));
}

@vertex
fn rock_shadow_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return geometry.clip_from_relative * vec4(placed_on_rock(index).relative, 1.0);
}

@vertex
fn shadow_vertex(
    @builtin(vertex_index) index: u32,
    @builtin(instance_index) instance: u32,
) -> @builtin(position) vec4<f32> {
    return geometry.clip_from_relative * vec4(placed(index, instance).relative, 1.0);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    return in.sample;
}
