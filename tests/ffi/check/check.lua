-- What tests/ffi/test.py asks of bindings/lua: luajit check.lua layout | MISTAKE, at the root of the repository.

package.path = "bindings/lua/?.lua;" .. package.path
local ffi = require("ffi")
local umbilic = require("umbilic")

-- A tetrahedron.
local INDICES, POSITIONS = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 }, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }
local function first(ctype, values, count)
  local array = ffi.new(ctype .. "[?]", count or #values)
  for i = 1, count or #values do array[i - 1] = values[i] end
  return array
end
local function indices(count) return first("uint32_t", INDICES, count) end
local function positions(count) return first("double", POSITIONS, count) end
local function tetrahedron() return umbilic.topology(indices(), nil, 4) end
local function not_a_number()
  local array = positions()
  array[7] = 0 / 0
  return array
end
local function same(a, b) return ffi.string(a, ffi.sizeof(a)) == ffi.string(b, ffi.sizeof(b)) end

-- LuaJIT has no list of a struct's fields; those of the header are on standard input.
local function layout()
  for line in io.lines() do
    local struct, field = line:match("^(umb_%w+[%w_]*)%.?([%w_]*)")
    if pcall(ffi.typeof, struct) then
      print(line:match("^%S+"), field == "" and ffi.sizeof(struct) or ffi.offsetof(struct, field))
    end
  end
end

local actions = {
  layout = layout,
  index = function()
    local wrong = indices()
    wrong[4] = 4
    umbilic.topology(wrong, nil, 4)
  end,
  offsets = function() umbilic.topology(indices(), first("uint32_t", { 0, 3, 2, 9, 12 }), 4) end,
  ["no-offsets"] = function() umbilic.topology(indices(), ffi.new("uint32_t[?]", 0), 4) end,
  ["indices-size"] = function() umbilic.topology(indices(11), nil, 4) end,
  count = function() umbilic.topology(indices(), nil, -1) end,
  ["positions-size"] = function() tetrahedron():vertex_normals(positions(9)) end,
  ragged = function() tetrahedron():curvatures(ffi.new("double[?]", 13)) end,
  type = function() tetrahedron():curvatures(ffi.new("float[?]", 12)) end,
  missing = function() tetrahedron():curvatures(nil) end,
  ["threads-of-topology"] = function() umbilic.topology(indices(), nil, 4, "x") end,
  ["threads-of-normals"] = function() tetrahedron():vertex_normals(positions(), "x") end,
  ["threads-of-curvatures"] = function() tetrahedron():curvatures(positions(), {}) end,
  ["nan-normals"] = function() tetrahedron():vertex_normals(not_a_number()) end,
  ["nan-curvatures"] = function() tetrahedron():curvatures(not_a_number()) end,
  ["closed-normals"] = function()
    local mesh = tetrahedron()
    mesh:close()
    mesh:vertex_normals(positions())
  end,
  ["closed-curvatures"] = function()
    local mesh = tetrahedron()
    mesh:close()
    mesh:curvatures(positions())
  end,
  twice = function()
    local mesh = tetrahedron()
    mesh:close()
    mesh:close()
  end,
  empty = function()
    local mesh = umbilic.topology(indices(0), nil, 0)
    assert(ffi.sizeof(mesh:vertex_normals(positions(0)).normal) == 0)
    assert(ffi.sizeof(mesh:curvatures(positions(0)).k1) == 0)
    mesh:close()
  end,
  threads = function()
    local one, three = umbilic.topology(indices(), nil, 4, 1), umbilic.topology(indices(), nil, 4, 3)
    assert(same(one:vertex_normals(positions(), 1).normal, three:vertex_normals(positions(), 3).normal))
    assert(same(one:curvatures(positions(), 1).k1, three:curvatures(positions(), 3).k1))
    one:close()
    three:close()
  end,
  forgotten = function()
    for _ = 1, 10 do tetrahedron() end
    collectgarbage()
    collectgarbage()
  end,
}

local good, failure = pcall(actions[arg[1]])
if not good then
  io.stderr:write(tostring(failure), "\n")
  os.exit(1)
end
