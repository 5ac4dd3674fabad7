-- Frames A5 0A with two sums, lines of commands and their answers, and tracks as lines.
local family = sonar.families.nortek
local T = family.tables
local longest_line, header = 512, 10
-- By family and id: name, table, bytes, version.
local kinds = {[0x20] = {[0xB4] = {"BottomTrack", "Track", 128, 1}, [0xBE] = {"WaterTrack", "Track", 128, 1},
                         [0xAA] = {"Altimeter", "Altimeter", 42, 1}, [0xD2] = {"Ahrs", "Ahrs", 108, 2}, [0x82] = {"Imu", "Imu", 44, 1}},
               [0x10] = {[0x1B] = {"DvlBottomTrack", "DvlTrack", 212, 1}, [0x1D] = {"DvlWaterTrack", "DvlTrack", 212, 1}}}
-- By the digit of $PNORBT or $PNORWT.
local lines = {["0"] = {"LineOfBeam"}, ["1"] = {"LineOfBeam", true}, ["3"] = {"LineOfSpeed", true}, ["4"] = {"LineOfSpeed"},
               ["6"] = {"LineOfVelocity", true}, ["7"] = {"LineOfVelocity"}, ["8"] = {"LineOfStatus", true}, ["9"] = {"LineOfStatus"}}
local text_field = sonar.text_field("sonar.nortek.text", "text", "of a line")
local sum_field = ProtoField.uint8("sonar.nortek.line_checksum", "checksum", base.HEX, nil, 0, "exclusive or of the characters")
for _, field in ipairs({text_field, sum_field}) do table.insert(family.fields, field) end

family.mark = "[ -~\165]"

local function sum_of(text)
  local sum = 0xB58C
  for i = 1, #text - 1, 2 do sum = sum + text:byte(i) + 256 * text:byte(i + 1) end
  if #text % 2 == 1 then sum = sum + 256 * text:byte(#text) end
  return sum % 0x10000
end

-- Address, table, whether its values have tags, values and sum of a line of a track; nil if it is another.
local function track_of(line)
  local address, values, sum = line:match("^%$(PNOR[BW]T%d),([^*]*)%*(%x%x)$")
  local kind = address and not address:match("^PNORWT[01]$") and lines[address:sub(7)]
  if kind then return address, T[kind[1]], kind[2], values, tonumber(sum, 16) end
end

local function xor_of(body)
  local sum = 0
  for i = 1, #body do sum = bit.bxor(sum, body:byte(i)) end
  return sum
end

local function show_value(tree, row, range, word)
  local number = row.type == "number" and tonumber(word)
  if number then
    sonar.add_unit(tree:add(row.field, range, number), row)
  elseif row.type == "number" then
    sonar.fault(tree, row.name .. ": not a number")
  else
    tree:add(row.field, range, word)
  end
end

local function show_track(tree, tvb, at, line)
  local address, tab, tags, values, sum = track_of(line)
  if not address then return nil end
  local place, from = 0, 1
  while from <= #values + 1 do
    local word = values:match("^[^,]*", from)
    place = place + 1
    local row = tab.rows[place]
    if not row then
      sonar.fault(tree, "more fields than it has")
      break
    end
    local before = tags and #(word:match("^%u+%d?=") or "") or 0
    if #word > before then show_value(tree, row, tvb(at + #address + 2 + from - 1 + before, #word - before), word:sub(before + 1)) end
    from = from + #word + 1
  end
  if place < #tab.rows then sonar.fault(tree, "the fields end here") end
  local item = tree:add(sum_field, tvb(at + #line - 2, 2), sum)
  sonar.check(item, "checksum", sum, xor_of(line:sub(2, -4)))
  return address
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
    local address = show_track(tree, tvb, at, line)
    if address then return address end
    tree:add(text_field, tvb(at, #line), line)
    return "Line"
  end
  sonar.show(family, tree, "Header", tvb, at, at + header)
  local of_family = kinds[text:byte(at + 4)]
  local kind = of_family and of_family[text:byte(at + 3)]
  local fits = kind and size - header == kind[3] and text:byte(at + header + 1) == kind[4]
  sonar.show(family, tree, fits and kind[2] or "Other", tvb, at + header, at + size)
  return fits and kind[1] or "Other"
end

function family.is_sure(text, at, size)
  if text:byte(at + 1) == 0xA5 then return family.good(text, at, size) end
  local line = text:sub(at + 1, at + size):match("^[^\r\n]*")
  local address, _, _, _, sum = track_of(line)
  return address ~= nil and sum == xor_of(line:sub(2, -4))
end

function family.sign(text)
  local size = family.frame(text, 0) or 0
  return size > 0 and size <= #text and family.is_sure(text, 0, size)
end
