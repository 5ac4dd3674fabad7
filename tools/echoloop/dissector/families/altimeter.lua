-- Lines of one number: xxx.xxxm CR LF, xxx.xxm CR LF, dmm LF.
local family = sonar.families.altimeter
local row = family.tables.Reading.rows_by_name
local shapes = {"^(%d%d%d%.%d%d%d?)(m)\r\n()", "^(%d%d?%d?%d?%d?%d?)(mm)\n()"}
local beginnings = {"^%d%d?%d?$", "^%d%d%d%.%d?%d?%d?m?\r?$", "^%d%d?%d?%d?%d?%d?m?m?$"}

family.mark = "%d"

local function line_at(text, at)
  for _, shape in ipairs(shapes) do
    local number, unit, stop = text:match(shape, at + 1)
    if number then return number, unit, stop - 1 - at end
  end
end

function family.frame(text, at)
  local _, _, size = line_at(text, at)
  if size then return at > 0 and text:match("^[%d.]", at) and 0 or size end
  for _, beginning in ipairs(beginnings) do
    if text:match(beginning, at + 1) then return nil end
  end
  return 0
end

function family.display(tree, tvb, at, _, text)
  local number, unit = line_at(text, at)
  tree:add(row.range.field, tvb(at, #number), tonumber(number)):append_text(" " .. unit)
  tree:add(row.unit.field, tvb(at + #number, #unit), unit)
  return "Reading"
end

function family.sign(text)
  local _, _, size = line_at(text, 0)
  return size == #text
end
