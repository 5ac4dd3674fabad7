-- Frames A5 0A with two sums, lines of commands and their answers.
local family = sonar.families.nortek
local longest_line, header = 512, 10
local kinds = {[0xB4] = {"BottomTrack", "Track", 128, 1}, [0xBE] = {"WaterTrack", "Track", 128, 1},
               [0xAA] = {"Altimeter", "Altimeter", 42, 1}, [0xD2] = {"Ahrs", "Ahrs", 108, 2}, [0x82] = {"Imu", "Imu", 44, 1}}
local text_field = sonar.text_field("sonar.nortek.text", "text", "of a line")
table.insert(family.fields, text_field)

family.mark = "[ -~\165]"

local function sum_of(text)
  local sum = 0xB58C
  for i = 1, #text - 1, 2 do sum = sum + text:byte(i) + 256 * text:byte(i + 1) end
  if #text % 2 == 1 then sum = sum + 256 * text:byte(#text) end
  return sum % 0x10000
end

function family.frame(text, at)
  if text:byte(at + 1) == 0xA5 then
    if #text - at >= 2 and text:byte(at + 2) ~= header then return 0 end
    if #text - at < header then return nil end
    if sum_of(text:sub(at + 1, at + 8)) ~= sonar.le(text, at + 8, 2) then return 0 end
    return header + sonar.le(text, at + 4, 2)
  end
  local line, stop = text:match("^([ -~]+)()", at + 1)
  if not line or #line > longest_line then return 0 end
  local ended = text:match("^\r?\n", stop) or text:match("^\r", stop)
  if ended then return #line + #ended end
  return stop > #text and nil or 0
end

function family.good(text, at, size)
  if text:byte(at + 1) ~= 0xA5 then return true end
  return sum_of(text:sub(at + header + 1, at + size)) == sonar.le(text, at + 6, 2)
end

function family.display(tree, tvb, at, size, text)
  if text:byte(at + 1) ~= 0xA5 then
    local line = text:sub(at + 1, at + size):match("^[^\r\n]*")
    tree:add(text_field, tvb(at, #line), line)
    return "Line"
  end
  sonar.show(family, tree, "Header", tvb, at, at + header)
  local kind = text:byte(at + 4) == 0x20 and kinds[text:byte(at + 3)]
  local fits = kind and size - header == kind[3] and text:byte(at + header + 1) == kind[4]
  sonar.show(family, tree, fits and kind[2] or "Other", tvb, at + header, at + size)
  return fits and kind[1] or "Other"
end

function family.is_sure(text, at, size) return text:byte(at + 1) == 0xA5 and family.good(text, at, size) end

function family.sign(text)
  local size = family.frame(text, 0) or 0
  return size > 0 and size <= #text and family.is_sure(text, 0, size)
end
