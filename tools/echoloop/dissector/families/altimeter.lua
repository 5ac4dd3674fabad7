-- Lines of one number, in the shapes that protocols/altimeter/line.h lists, and the four bytes of an Imagenex 863.
local family = sonar.families.altimeter
local row, time = family.tables.Reading.rows_by_name, family.tables.Time.rows_by_name
local time_size = 4
-- What stands before the number, the number, what stands behind it; sure ones may follow other bytes on their line.
local sure = {"^([A-H]?)(%d%d%d%.%d%d%d)(m)\r\n()", "^()(%d%d%d%.%d%d)(m)\r\n()", "^()(%d%d%.%d%d%d)(m)\r\n()",
              "^(R)(%d%d%.%d%d)([E<]?)\r\n()", "^()(%d%d?%d?%d?%d?%d?)(mm)\n()"}
local alone = {"^()(%d%d?%d?%.%d%d%d)()\r\n()", "^()(%d%d%d%d%d)()\r\n()"}
local beginnings = {"^[A-H]?%d?%d?%d?%.?%d*m?\r?$", "^R%d?%d?%.?%d?%d?[E<]?\r?$", "^%d%d?%d?%d?%d?%d?m?m?\r?$"}
local longest = 11

family.mark = "[%dA-HR\xFF]"

local function line_at(text, at)
  for number, shape in ipairs({sure[1], sure[2], sure[3], sure[4], sure[5], alone[1], alone[2]}) do
    local before, digits, unit, stop = text:match(shape, at + 1)
    if digits and (number <= #sure or at == 0 or text:sub(at, at) == "\n") then
      local from = before == "R" and 1 or type(before) == "string" and #before or 0
      return from, digits, type(unit) == "string" and unit or "", stop - 1 - at
    end
  end
end

function family.frame(text, at)
  if text:byte(at + 1) == 0xFF then
    local next = text:byte(at + time_size + 1)
    return (#text - at < time_size or not next or next == 0xFF) and time_size or 0
  end
  local _, _, _, size = line_at(text, at)
  if size then return at > 0 and text:match("^[%d.]", at) and 0 or size end
  if #text - at > longest then return 0 end
  for _, beginning in ipairs(beginnings) do
    if text:match(beginning, at + 1) then return nil end
  end
  return 0
end

function family.display(tree, tvb, at, _, text)
  if text:byte(at + 1) == 0xFF then
    tree:add(time.start.field, tvb(at, 1))
    tree:add(time.time.field, tvb(at + 1, 2))
    tree:add(time.level.field, tvb(at + 3, 1))
    return "Time"
  end
  local from, number, unit = line_at(text, at)
  tree:add(row.range.field, tvb(at + from, #number), tonumber(number)):append_text(" " .. (unit ~= "" and unit or "m"))
  if unit ~= "" then tree:add(row.unit.field, tvb(at + from + #number, #unit), unit) end
  return "Reading"
end

-- Numbers alone and four bytes may be anybody's.
function family.is_sure(text, at, size)
  return text:byte(at + 1) ~= 0xFF and not text:sub(at + 1, at + size):match("^[%d.]+\r\n$")
end

function family.sign(text)
  local _, _, _, size = line_at(text, 0)
  return size == #text and family.is_sure(text, 0, size)
end
