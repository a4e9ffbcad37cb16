-- Vertex normals and curvatures of a mesh with umbilic.
--
--   luajit curvature.lua MESH.off RESULTS    writes them as doubles, statuses as bytes, one array after the other
--   luajit curvature.lua --time MESH.off     prints how long each call takes, in milliseconds, on one thread

package.path = (arg[0]:match("^(.*/)") or "./") .. "?.lua;" .. package.path
local ffi = require("ffi")
local umbilic = require("umbilic")

-- The lines of an OFF file that say something, each as a list of words.
local function lines(file)
  local next_line = file:lines()
  return function()
    for line in next_line do
      local words = {}
      for word in line:gsub("#.*", ""):gmatch("%S+") do words[#words + 1] = word end
      if #words > 0 then return words end
    end
    error("the file ends early", 0)
  end
end

-- The number at a place of a line; and one from 0, as indices and counts are.
local function number(words, place)
  return tonumber(words[place] or "") or error("cannot read: " .. table.concat(words, " "), 0)
end
local function natural(words, place)
  local value = number(words, place)
  if value % 1 ~= 0 or value < 0 or value >= 2 ^ 32 then error("cannot read: " .. table.concat(words, " "), 0) end
  return value
end

local function read_off(path)
  local file = assert(io.open(path))
  local line = lines(file)
  local counts = line()
  assert(table.remove(counts, 1) == "OFF", path .. ": no OFF file")
  if #counts == 0 then counts = line() end
  local vertex_count, face_count = natural(counts, 1), natural(counts, 2)
  local positions = ffi.new("double[?]", 3 * vertex_count)
  for vertex = 0, vertex_count - 1 do
    local words = line()
    for axis = 0, 2 do positions[3 * vertex + axis] = number(words, axis + 1) end
  end
  local corners, offsets = {}, ffi.new("uint32_t[?]", face_count + 1)
  for face = 1, face_count do
    local words = line()
    for corner = 1, natural(words, 1) do corners[#corners + 1] = natural(words, corner + 1) end
    offsets[face] = #corners
  end
  file:close()
  local indices = ffi.new("uint32_t[?]", #corners)
  for i = 1, #corners do indices[i - 1] = corners[i] end
  return positions, indices, offsets, vertex_count
end

local function write(path, normals, curvatures)
  local file = assert(io.open(path, "wb"))
  for _, array in ipairs { normals.normal, normals.status, curvatures.k1, curvatures.k2, curvatures.direction1,
    curvatures.direction2, curvatures.mean, curvatures.gaussian, curvatures.status } do
    assert(file:write(ffi.string(array, ffi.sizeof(array))))
  end
  assert(file:close())
end

local function time(path)
  ffi.cdef [[
    typedef struct { long seconds, nanoseconds; } timespec;
    int clock_gettime(int clock, timespec *time);
  ]]
  local spec = ffi.new("timespec")
  local function now()
    ffi.C.clock_gettime(1, spec) -- CLOCK_MONOTONIC
    return tonumber(spec.seconds) * 1e3 + tonumber(spec.nanoseconds) * 1e-6
  end
  local positions, indices, offsets, vertex_count = read_off(path)
  for _ = 1, 20 do
    local start = now()
    local mesh = umbilic.topology(indices, offsets, vertex_count, 1)
    local built = now()
    mesh:vertex_normals(positions, 1)
    local shaded = now()
    mesh:curvatures(positions, 1)
    local done = now()
    print(("%.6f\t%.6f\t%.6f"):format(built - start, shaded - built, done - shaded))
    mesh:close()
  end
end

local function main(first, second)
  if not second then error("usage: curvature.lua MESH.off RESULTS | --time MESH.off", 0) end
  if first == "--time" then return time(second) end
  local positions, indices, offsets, vertex_count = read_off(first)
  -- begin: user code
  local mesh = umbilic.topology(indices, offsets, vertex_count)
  local normals = mesh:vertex_normals(positions)
  local curvatures = mesh:curvatures(positions)
  mesh:close()
  -- end: user code
  write(second, normals, curvatures)
end

local good, failure = pcall(main, ...)
if not good then
  io.stderr:write(tostring(failure), "\n")
  os.exit(1)
end
