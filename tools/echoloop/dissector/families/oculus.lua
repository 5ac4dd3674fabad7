-- Messages "SO" with a header that says id, version and size.
local family = sonar.families.oculus
local header, longest, longest_text = 16, 9 * 1024 * 1024, 4096
local fixed, least = {}, {}
local T = family.tables
local function size_of(name) return sonar.fixed_size(T, T[name]) end
local function least_of(name)
  local sum = 0
  for _, row in ipairs(T[name].rows) do
    if row.kind ~= "counted" and row.kind ~= "rest" then
      sum = sum + (row.kind == "group" and size_of(row.type) or sonar.size_of(row)) * (row.elements or 1)
    end
  end
  return sum
end

local names = {[0x15] = {"Fire", "FireV2"}, [0x22] = {"FullResult"}, [0x23] = {"Result", "ResultV2"},
               [0x55] = {"UserConfig"}, [0x80] = {"LogText"}, [0xFF] = {"Dummy"}}

local function table_of(text, at)
  local id, version = sonar.le(text, at + 6, 2), sonar.le(text, at + 8, 2)
  local pair = names[id]
  return pair and (version == 2 and pair[2] or pair[1]) or "Status", version
end

local function fits(name, size)
  if name == "FullResult" then return size >= size_of("Fire") and size <= longest end
  if name == "LogText" then return size <= longest_text end
  local all = size_of(name)
  if all then return size == all or (size == 0 and name:sub(1, 4) == "Fire") end
  return size >= least_of(name) and size <= longest
end

family.mark = "S"

function family.frame(text, at)
  local start = text:sub(at + 1, at + 2)
  if start ~= ("SO"):sub(1, #start) then return 0 end
  if #text - at < header then return nil end
  local size = sonar.le(text, at + 10, 4)
  local name, version = table_of(text, at)
  if version > 2 or not fits(name, size) then return 0 end
  return header + (size == 0 and size_of(name) or size)  -- some hosts leave a Fire's size out
end

function family.display(tree, tvb, at, size, text)
  local name = table_of(text, at)
  sonar.walk(sonar.reader(family, tvb, at, at + header), T.Header, tree)
  return sonar.show(family, tree, name, tvb, at + header, at + size)
end

function family.sign(text) return (family.frame(text, 0) or 0) > 0 end
