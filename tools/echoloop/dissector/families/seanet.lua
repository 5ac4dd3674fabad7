-- Frames from '@' to LF; ids by the names of the header's field, head commands by their first byte.
local family = sonar.families.seanet
local header_at, payload_at, overhead, longest = 7, 13, 14, 4096
local head_command, head_data, profiler = 19, 2, 20
local commands = {[0x01] = "HeadCommand", [0x1D] = "HeadCommandDual", [0x0F] = "HeadCommandReverse", [0x1E] = "HeadCommandGain"}
local profiler_names = {HeadCommandDual = "ProfilerCommand", HeadCommandGain = "ProfilerGainCommand", HeadData = "ProfilerData"}
local id_names = {}
for _, pair in ipairs(family.tables.Header.rows_by_name.id.names) do id_names[pair[1]] = pair[2] end

family.mark = "@"

function family.frame(text, at)
  if text:byte(at + 1) ~= 0x40 then return 0 end
  local seen = text:sub(at + 2, at + 5)
  if not seen:match("^[0-9A-F]*$") then return 0 end
  local length = sonar.le(text, at + 5, 2)
  if not length then return nil end
  local size = length + 6
  return tonumber(seen, 16) == length and size >= overhead and size <= longest and size or 0
end

function family.good(text, at, size) return text:byte(at + size) == 0x0A end

local function name_of(text, at, size)
  local id = text:byte(at + 11)
  local name = id_names[id]
  if id == head_command then name = commands[size > overhead and text:byte(at + payload_at + 1)] end
  local node = text:byte(at + (id == head_data and 8 or 9))
  return node == profiler and profiler_names[name] or name, id
end

function family.display(tree, tvb, at, size, text)
  local name, id = name_of(text, at, size)
  local r = sonar.reader(family, tvb, at, at + payload_at)
  local frame = {rows = {}}
  for _, row in ipairs(family.tables.Frame.rows) do
    if row.name ~= "payload" and row.name ~= "end" then table.insert(frame.rows, row) end
  end
  sonar.walk(r, frame, tree)
  if name and family.tables[name] then
    sonar.show(family, tree, name, tvb, at + payload_at, at + size - 1)
  else
    sonar.fault(tree, "no message that is known")
  end
  return name or "id " .. id
end

function family.sign(text)
  local size = family.frame(text, 0)
  return size and size > 0 and #text >= overhead
end
