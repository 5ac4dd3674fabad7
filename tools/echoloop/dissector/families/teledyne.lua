-- PD0 ensembles 7F 7F with a table of offsets, PD4 and PD5 blocks 7D, lines of PD6 and of the console. A sum tells the first two.
local family = sonar.families.teledyne
local longest_line, longest_ensemble, header = 200, 8192, 6
local heads = {["}\0\45\0"] = {"PD4", 47}, ["}\1\86\0"] = {"PD5", 88}}
local sections = {[0x0000] = "FixedLeader", [0x0080] = "VariableLeader", [0x0100] = "Velocity", [0x0200] = "Correlation",
                  [0x0300] = "Intensity", [0x0400] = "PercentGood", [0x0600] = "BottomTrack"}
local text_field = sonar.text_field("sonar.teledyne.text", "text", "of the console")
local other_field = sonar.text_field("sonar.teledyne.field", "field", "of a line that has no more names")
for _, field in ipairs({text_field, other_field}) do table.insert(family.fields, field) end

family.mark = "[ -~\127]"

-- Where the sections of the ensemble at `at` begin, and where the last one ends; nil: none begins here.
local function contents(text, at)
  local size, count = sonar.le(text, at + 2, 2), text:byte(at + 6)
  if not size or not count or count == 0 or #text - at < header + 2 * count then return nil end
  local offsets, least = {}, header + 2 * count
  for i = 1, count do
    local offset = sonar.le(text, at + header + 2 * (i - 1), 2)
    if offset < least or offset + 2 > size then return nil end
    offsets[i], least = offset, offset + 2
  end
  return offsets[1] == header + 2 * count and offsets or nil, size
end

local function frame_ensemble(text, at)
  if #text - at < 2 then return nil end
  if text:byte(at + 2) ~= 0x7F then return 0 end
  local size, count = sonar.le(text, at + 2, 2), text:byte(at + 6)
  if not size or not count then return nil end
  if size > longest_ensemble or count == 0 or header + 2 * count >= size then return 0 end
  if #text - at < header + 2 * count then return nil end
  return contents(text, at) and size + 2 or 0
end

function family.frame(text, at)
  local first = text:byte(at + 1)
  if first == 0x7F then return frame_ensemble(text, at) end
  if first == 0x7D then
    local seen = text:sub(at + 1, at + 4)
    for head, kind in pairs(heads) do
      if head == seen then return kind[2] end
      if #seen < 4 and head:sub(1, #seen) == seen then return nil end
    end
    return 0
  end
  local line, stop = text:match("^([ -|~]+)()", at + 1)
  if not line or #line > longest_line then return 0 end
  local ended = text:match("^\r?\n", stop) or text:match("^\r", stop)
  if ended then return #line + #ended end
  if stop > #text then return nil end
  local next = text:byte(stop)
  return (next == 0x7F or next == 0x7D) and #line or 0
end

function family.good(text, at, size)
  local first = text:byte(at + 1)
  if first ~= 0x7F and first ~= 0x7D then return true end
  return sonar.le(text, at + size - 2, 2) == sonar.sum(text:sub(at + 1, at + size - 2)) % 0x10000
end

function family.display(tree, tvb, at, size, text)
  local first = text:byte(at + 1)
  if first == 0x7D then
    local name = heads[text:sub(at + 1, at + 4)][1]
    sonar.show(family, tree, name, tvb, at, at + size)
    return name
  elseif first ~= 0x7F then
    local line = text:sub(at + 1, at + size):match("^[^\r\n]*")
    local tab = family.tables[line:match("^:(%u%u),") or ""]
    if tab then
      sonar.show_list(tree, tvb, at + 4, line:sub(5), tab, other_field)
      return line:sub(2, 3)
    end
    tree:add(text_field, tvb(at, #line), line)
    return "Console"
  end
  local offsets, stop = contents(text, at)
  for i, offset in ipairs(offsets) do
    local name = sections[sonar.le(text, at + offset, 2)] or "Other"
    sonar.show(family, tree, name, tvb, at + offset, at + (offsets[i + 1] or stop))
  end
  return "Ensemble"
end

function family.sign(text)
  local size = family.frame(text, 0) or 0
  return size > 0 and size <= #text and family.is_sure(text, 0, size)
end

function family.is_sure(text, at, size)
  local first = text:byte(at + 1)
  return (first == 0x7F or first == 0x7D) and family.good(text, at, size)
end
