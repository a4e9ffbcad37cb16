-- umbilic for LuaJIT: vertex normals and curvatures of polygon meshes, on FFI arrays. See include/umbilic.h for what everything means.
--
--   local umbilic = require("umbilic")
--   local mesh = umbilic.topology(indices, nil, vertex_count)   -- uint32_t[?], triangles
--   local found = mesh:curvatures(positions)                    -- double[?], x y z of each vertex
--   print(found.k1[0], found.direction1[0])
--
-- Arrays are those of ffi.new("double[?]", n) and are neither copied nor kept. What fails raises an error with the fields status,
-- element (nil if there is none) and message. A topology is freed by close(), or when it is collected; like any value it belongs to
-- one Lua state.

local ffi = require("ffi")

ffi.cdef [[
typedef struct umb_topology umb_topology;
typedef struct { uint32_t struct_size; int32_t status; uint64_t element; char message[240]; } umb_error;
typedef struct {
  const void *indices; size_t index_count; const void *offsets; size_t face_count; uint32_t index; uint32_t arity;
} umb_faces;
typedef struct { uint32_t struct_size; uint32_t threads; uint32_t simd; uint32_t reserved; } umb_topology_options;
typedef struct { const void *data; size_t count; size_t stride; uint32_t scalar; uint32_t reserved; } umb_points;
typedef struct { void *data; size_t stride; uint32_t scalar; uint32_t reserved; } umb_output;
typedef struct { uint8_t *data; size_t stride; } umb_status_output;
typedef struct {
  uint32_t threads; uint32_t simd; const uint32_t *vertices; size_t vertex_count;
  int (*progress)(void *user, double fraction); void *user;
} umb_run;
typedef struct {
  uint32_t struct_size; uint32_t weight; umb_run run; uint32_t degree; uint32_t rings; const void *model;
} umb_normal_options;
typedef struct {
  uint32_t struct_size; uint32_t reserved; umb_output normal; umb_output sum; umb_status_output status;
} umb_normal_outputs;
typedef struct {
  uint32_t struct_size; uint32_t method; uint32_t section; uint32_t weight; double radius; uint32_t degree; uint32_t rings;
  uint32_t normal_degree; uint32_t normal_rings; const void *model; umb_points normals; umb_run run;
} umb_curvature_options;
typedef struct {
  uint32_t struct_size; uint32_t reserved;
  umb_output k1; umb_output k2; umb_output direction1; umb_output direction2; umb_output mean; umb_output gaussian;
  umb_output mean_normal; umb_output area; umb_output integrated_mean; umb_output integrated_gaussian; umb_output shape_index;
  umb_output curvedness; umb_output residual; umb_output condition; umb_output degrees_of_freedom; umb_output normal;
  umb_status_output status;
} umb_curvature_outputs;

uint32_t umb_abi_version(void);
int32_t umb_topology_create(const umb_faces *faces, size_t vertex_count, const umb_topology_options *options,
                            umb_topology **topology, umb_error *error);
void umb_topology_destroy(umb_topology *topology);
size_t umb_topology_vertex_count(const umb_topology *topology);
int32_t umb_vertex_normals(const umb_topology *topology, const umb_points *points, const umb_normal_options *options,
                           const umb_normal_outputs *outputs, umb_error *error);
int32_t umb_curvatures(const umb_topology *topology, const umb_points *points, const umb_curvature_options *options,
                       const umb_curvature_outputs *outputs, umb_error *error);
]]

local library = ffi.load("libumbilic.so.0")
assert(library.umb_abi_version() == 0, "libumbilic has another binary interface than umbilic.lua")

local F64, SIZE = 1, 7 -- UMB_SCALAR_F64, UMB_ERROR_SIZE
local NO_ELEMENT = 0xffffffffffffffffULL

local Error = {}
Error.__index = Error
function Error:__tostring()
  return ("umbilic: %s (status %d%s)"):format(self.message, self.status,
    self.element and (", element %d"):format(self.element) or "")
end

local function raise(status, message, element)
  error(setmetatable({ status = status, message = message, element = element }, Error), 0)
end

-- A struct whose first field is its size.
local function sized(ctype)
  local value = ffi.new(ctype)
  value.struct_size = ffi.sizeof(value)
  return value
end

-- Calls a function that takes an umb_error as its last argument. Never compiled: the interpreter keeps whatever its callers hold in
-- locals until they return, and so the arrays that structs only point to.
local function call(name, ...)
  local failure = sized("umb_error")
  local arguments = { ... }
  arguments[select("#", ...) + 1] = failure
  local status = library[name](unpack(arguments, 1, select("#", ...) + 1))
  if status ~= 0 then
    raise(status, ffi.string(failure.message), failure.element ~= NO_ELEMENT and tonumber(failure.element) or nil)
  end
end
jit.off(call)

-- The number of elements; only arrays that LuaJIT knows the length of are taken, so that none is read beyond its end.
local function length(array, ctype, what)
  if not ffi.istype(ctype .. "[?]", array) then raise(SIZE, what .. " is no " .. ctype .. "[?] of ffi.new") end
  return ffi.sizeof(array) / ffi.sizeof(ctype)
end

local Topology = {}
Topology.__index = Topology

-- indices: uint32_t[?], all faces one after the other, from 0. offsets: uint32_t[?], where each face starts and the last ends, or nil
-- for triangles. threads: nil for as many as pay.
local function topology(indices, offsets, vertex_count, threads)
  local faces, options, handle = ffi.new("umb_faces"), sized("umb_topology_options"), ffi.new("umb_topology *[1]")
  faces.indices, faces.index_count = indices, length(indices, "uint32_t", "indices")
  if offsets then
    faces.offsets, faces.face_count = offsets, length(offsets, "uint32_t", "offsets") - 1
  end
  options.threads = threads or 0
  call("umb_topology_create", faces, vertex_count, options, handle)
  return setmetatable({ handle = ffi.gc(handle[0], library.umb_topology_destroy) }, Topology)
end
jit.off(topology)

-- Frees the topology now; what is called afterwards raises an error.
function Topology:close()
  if self.handle then
    library.umb_topology_destroy(ffi.gc(self.handle, nil))
    self.handle = nil
  end
end

local function points_of(positions)
  local points = ffi.new("umb_points")
  local scalars = length(positions, "double", "positions")
  if scalars % 3 ~= 0 then raise(SIZE, "positions are no multiple of 3 numbers") end
  points.data, points.count, points.scalar = positions, scalars / 3, F64
  return points
end

local function add(outputs, results, name, ctype, count)
  results[name] = ffi.new(ctype .. "[?]", count)
  outputs[name].data = results[name]
  if ctype == "double" then outputs[name].scalar = F64 end
end

-- Unit normals (N_CM), `normal` with x y z of each vertex, and `status`, its UMB_VERTEX_ bits.
function Topology:vertex_normals(positions, threads)
  local points, options, outputs = points_of(positions), sized("umb_normal_options"), sized("umb_normal_outputs")
  local count = tonumber(library.umb_topology_vertex_count(self.handle))
  local normals = {}
  options.run.threads = threads or 0
  add(outputs, normals, "normal", "double", 3 * count)
  add(outputs, normals, "status", "uint8_t", count)
  call("umb_vertex_normals", self.handle, points, options, outputs)
  return normals
end
jit.off(Topology.vertex_normals)

-- Curvatures by adaptive jets: k1, k2, mean, gaussian; direction1 and direction2 with x y z of each vertex; status, its UMB_VERTEX_ bits.
function Topology:curvatures(positions, threads)
  local points, options, outputs = points_of(positions), sized("umb_curvature_options"), sized("umb_curvature_outputs")
  local count = tonumber(library.umb_topology_vertex_count(self.handle))
  local curvatures = {}
  options.run.threads = threads or 0
  for _, name in ipairs { "k1", "k2", "mean", "gaussian" } do add(outputs, curvatures, name, "double", count) end
  for _, name in ipairs { "direction1", "direction2" } do add(outputs, curvatures, name, "double", 3 * count) end
  add(outputs, curvatures, "status", "uint8_t", count)
  call("umb_curvatures", self.handle, points, options, outputs)
  return curvatures
end
jit.off(Topology.curvatures)

return { topology = topology }
