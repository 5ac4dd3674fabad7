-- Protobuf: beacons and parts of frames are datagrams, commands a stream with a u32 big-endian length before each.
local family = sonar.families.aris
local T = family.tables
local length_bytes, longest_command, header_version = 4, 65535, 0x05464444
local header_bytes = sonar.fixed_size(T, T.FrameHeader)
local udp = 3

-- The fields of a message by number: numbers, or {from, to}; nil if it is none, or has fields that the table lacks.
local function fields_of(text, tab)
  local out, known = {}, {}
  for _, row in ipairs(tab.rows) do known[row.offset] = true end
  local strange = false
  local good = sonar.each_field(text, 0, #text, function(number, kind, from, to, low, high)
    strange = strange or not known[number]
    out[number] = kind == 0 and low + high * 2 ^ 32 or {from, to}
  end)
  return good and not strange and out or nil
end

local function size_of(field) return type(field) == "table" and field[2] - field[1] or 0 end
local function number_of(field) return type(field) == "number" and field or 0 end

local function is_beacon(text)
  local f = fields_of(text, T.Availability)
  return f ~= nil and number_of(f[1]) > 0 and size_of(f[3]) > 0 and number_of(f[2]) <= 2 and number_of(f[4]) <= 1 and
         type(f[4]) == "number"
end

local function is_part(text)
  local f = fields_of(text, T.FramePart)
  if not f or number_of(f[1]) == 0 or size_of(f[4]) == 0 then return false end
  local at = number_of(f[5])
  if at + size_of(f[4]) > number_of(f[2]) then return false end
  if at > 0 then return size_of(f[3]) == 0 end
  return size_of(f[3]) >= header_bytes and
         sonar.le(text, f[3][1] + T.FrameHeader.rows_by_name.version.offset, 4) == header_version
end

-- The rows that the type of a command announces, in the order of their numbers.
local function is_command(text)
  local f = fields_of(text, T.Command)
  if not f or (f[1] ~= nil and type(f[1]) ~= "number") then return false end
  local kind = number_of(f[1])
  return kind <= 15 and (f[kind + 2] ~= nil or kind == 8 or kind == 14)
end

local function kind_of(text)
  if is_beacon(text) then return "Availability" end
  return is_part(text) and "FramePart" or nil
end

family.mark = "%z"
family.resumes = true

function family.frame(text, at)
  if (text:byte(at + 1) or 0) ~= 0 or (text:byte(at + 2) or 0) ~= 0 then return 0 end
  local size = sonar.be(text, at, length_bytes)
  if not size then return nil end
  return size >= 2 and size <= longest_command and size + length_bytes or 0
end

function family.good(text, at, size) return is_command(text:sub(at + length_bytes + 1, at + size)) end

function family.display(tree, tvb, at, size, text)
  sonar.show_protobuf(family, tree, T.Command, tvb, text, at + length_bytes, at + size)
  return "Command"
end

local parts = {}
function parts.header(tree, tvb, _, from, to)
  local item = tree:add(T.FramePart.rows_by_name.header.field, tvb(from, to - from))
  sonar.walk(sonar.reader(family, tvb, from, to), T.FrameHeader, item)
end

local function dissect_datagram(tvb, pinfo, tree)
  local text = tvb:raw()
  local name = kind_of(text)
  if not name then return 0 end
  local item = tree:add(family.proto, tvb())
  item:append_text(", " .. name)
  sonar.show_protobuf(family, item, T[name], tvb, text, 0, #text, parts)
  pinfo.cols.protocol = family.name
  pinfo.cols.info = name
  return tvb:len()
end

function family.sign(text)
  if kind_of(text) then return true end
  local size = family.frame(text, 0)
  return size and size > 0 and size <= #text and family.good(text, 0, size)
end

local dissect_stream = sonar.dissector_of(family)
function family.dissect(tvb, pinfo, tree)
  if pinfo.port_type == udp then return dissect_datagram(tvb, pinfo, tree) end
  return dissect_stream(tvb, pinfo, tree)
end
