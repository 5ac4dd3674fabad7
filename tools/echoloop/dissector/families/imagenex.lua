-- Commands of 27 bytes up to FD, replies "I?X" up to FC, and the shots of the maker's files.
local family = sonar.families.imagenex
local T = family.tables
local command_bytes, overhead, shot_header = 27, 13, 100
local pipe_overhead, pipe_shot, pipe_reply_at = 33, 512, 228  -- of an 831L
local azimuth_head = T.AzimuthReply.rows_by_name.head_id.constant
local replies = {M = "IMX", G = "IGX", P = "IPX", A = "IAX"}
local base_sizes = {[0] = 128, 256, 384, 640}

family.mark = "[I83\xFE]"

local function command_frame(text, at)
  if (text:byte(at + 2) or 0x44) ~= 0x44 then return 0 end
  local stop = text:find("\xFD", at + 1, true)
  if stop then return stop - at == command_bytes and command_bytes or 0 end
  if #text - at < command_bytes then return nil end
  return 0
end

-- Other heads have their id, 10 or more, where an 831L has its type.
local function is_of_831l(text, at)
  local second = text:sub(at + 2, at + 2)
  return (second == "M" or second == "P") and text:byte(at + 4) <= 1
end

local function reply_frame(text, at)
  local second, third = text:sub(at + 2, at + 2), text:byte(at + 3)
  if second ~= "" and not replies[second] or (third or 0x58) ~= 0x58 then return 0 end
  if #text - at < overhead then return nil end
  if second == "A" then return text:byte(at + 4) == azimuth_head and overhead or 0 end
  local low, high = text:byte(at + 11), text:byte(at + 12)
  if low > 127 or high > 127 then return 0 end
  local data = high * 128 + low
  if is_of_831l(text, at) then return data == (second == "M" and 250 or 0) and pipe_overhead + data or 0 end
  local legal = data == 0 or data == 128 or data == 250 or data == 252 or data == 500 or data == 1000
  return legal and overhead + data or 0
end

local function pipe_shot_frame(text, at)
  local name = text:sub(at + 1, at + 3)
  if name ~= ("31L"):sub(1, #name) then return 0 end
  if #text - at < 35 then return nil end
  local fits = text:byte(at + 4) == 2 and sonar.be(text, at + 4, 2) == pipe_shot and sonar.be(text, at + 6, 2) == pipe_overhead + 250
  return fits and pipe_shot or 0
end

local function shot_frame(text, at)
  local name = text:sub(at + 1, at + 3)
  if name ~= ("852"):sub(1, #name) and name ~= ("81A"):sub(1, #name) then return 0 end
  if #text - at < 35 then return nil end
  local size = base_sizes[text:byte(at + 4)]
  if not size then return 0 end
  local all = size + (name == "81A" and text:byte(at + 35) * 128 or 0)
  local total, reply = sonar.be(text, at + 4, 2), sonar.be(text, at + 6, 2)
  return (total == all or total == size) and reply >= overhead and reply <= size - shot_header and all or 0
end

function family.frame(text, at)
  local first = text:byte(at + 1)
  if first == 0xFE then return command_frame(text, at) end
  if first == 0x49 then return reply_frame(text, at) end
  if first == 0x38 then return shot_frame(text, at) end
  if first == 0x33 then return pipe_shot_frame(text, at) end
  return 0
end

function family.good(text, at, size)
  local first = text:byte(at + 1)
  return first ~= 0x49 or text:byte(at + size) == 0xFC
end

-- The tables say a number of 14 bits as two bytes of 7; here it is one. A head's position has its direction above.
for _, name in ipairs({"Reply", "PipeReply", "AzimuthReply", "AzimuthCommand"}) do
  for _, row in ipairs(T[name].rows) do
    if row.type == "Packed14" then sonar.replace_field(family, row, sonar.number_field(row)) end
    if row.type == "Signed14" then sonar.replace_field(family, row, sonar.signed_field(row)) end
  end
end

local function read_packed(r, tree, row)
  if r.stop - r.at < 2 then return sonar.fault(tree, row.name .. ": the bytes end here") end
  local range = r.tvb(r.at, 2)
  local value = range(1, 1):uint() % 128 * 128 + range(0, 1):uint() % 128
  local turns = row.name == "head_position"
  local item = tree:add(row.field, range, turns and value % 8192 or value)
  sonar.add_unit(item, row)
  if turns then item:append_text(value >= 8192 and ", clockwise" or ", counter-clockwise") end
  if row.kind == "count" then r.counts[row.key] = value end
  r.at = r.at + 2
  return true
end

-- What an inclinometer says: 14 signed bits below two flags.
local function read_signed(r, tree, row)
  if r.stop - r.at < 2 then return sonar.fault(tree, row.name .. ": the bytes end here") end
  local range = r.tvb(r.at, 2)
  local high = range(1, 1):uint()
  local value = high % 64 * 256 + range(0, 1):uint()
  local item = tree:add(row.field, range, value >= 8192 and value - 16384 or value)
  sonar.add_unit(item, row)
  if high >= 128 then item:append_text(", new") end
  if high % 128 >= 64 then item:append_text(", alarm") end
  r.at = r.at + 2
  return true
end

local function show_table(tree, name, tvb, at, stop)
  local r = sonar.reader(family, tvb, at, stop)
  r.special = {Packed14 = read_packed, Signed14 = read_signed}
  if sonar.walk(r, T[name], tree) and r.at < stop then sonar.fault(tree, "bytes left over") end
end

local function show_one(tree, tvb, at, size, text)
  local first, second = text:byte(at + 1), text:sub(at + 2, at + 2)
  if first == 0x49 and is_of_831l(text, at) then
    show_table(tree, "PipeReply", tvb, at, at + size)
    return replies[second] .. "831L"
  end
  if first == 0x49 and second ~= "A" then
    show_table(tree, "Reply", tvb, at, at + size)
    return replies[second]
  end
  local azimuth = first == 0xFE and text:byte(at + 3) == azimuth_head
  local name = first == 0x49 and "AzimuthReply" or azimuth and "AzimuthCommand" or "SwitchCommand"
  show_table(tree, name, tvb, at, at + size)
  return first == 0x49 and "IAX" or name
end

local function show_shot(tree, tvb, at, size, text)
  local name = "Shot" .. text:sub(at + 1, at + 3)
  sonar.show(family, tree, name, tvb, at, at + size)
  local reply, inner = sonar.be(text, at + 6, 2), at + (name == "Shot31L" and pipe_reply_at or shot_header)
  if reply_frame(text, inner) == reply then show_one(tree, tvb, inner, reply, text) end
  return name
end

function family.display(tree, tvb, at, size, text)
  local first = text:byte(at + 1)
  if first == 0x38 or first == 0x33 then return show_shot(tree, tvb, at, size, text) end
  return show_one(tree, tvb, at, size, text)
end

function family.sign(text)
  local size = family.frame(text, 0)
  return size and size > 0 and size <= #text and family.good(text, 0, size)
end
