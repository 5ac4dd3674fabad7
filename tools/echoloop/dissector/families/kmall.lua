-- Datagrams {size, "#MRZ", ..., size} of structs that say their own size; "$KSSIS," is a controller's text, "$MVS01,00000,"
-- one with a profile of the speed of sound.
local family = sonar.families.kmall
family.datagram = true
family.mark = "[%z\1-\255]"
local header, tail, command = 20, 4, "$KSSIS,"
local T = family.tables
local command_fields = {
  ProtoField.uint32("sonar.kmall.KSSIS.number", "number", base.DEC, nil, 0, "of the command"),
  sonar.text_field("sonar.kmall.KSSIS.sounder", "sounder", "its name, e.g. EM2040_40"),
  sonar.text_field("sonar.kmall.KSSIS.arguments", "arguments", "of the command"),
}
for _, field in ipairs(command_fields) do table.insert(family.fields, field) end
local image_field = ProtoField.bytes("sonar.kmall.image", "image", base.NONE, "seabed image of all soundings, i16 of 0.1 dB")
local amplitude_field = ProtoField.bytes("sonar.kmall.amplitude", "amplitude", base.NONE, "i8 of 0.5 dB")
local phase_field = ProtoField.bytes("sonar.kmall.phase", "phase", base.NONE, "of the samples of a beam")
local parameters_field = sonar.text_field("sonar.kmall.text", "text", "installation or runtime parameters")
local part_field = ProtoField.bytes("sonar.kmall.part", "part", base.NONE, "of a divided datagram")
local surplus_field = ProtoField.bytes("sonar.kmall.surplus", "surplus", base.NONE, "padding, or a point that means nothing")
local file_field = ProtoField.bytes("sonar.kmall.file", "file", base.NONE, "of #FCF")
for _, field in ipairs({image_field, amplitude_field, phase_field, part_field, parameters_field, surplus_field, file_field}) do
  table.insert(family.fields, field)
end

local function is_command(text, at) return text:sub(at + 1, at + #command) == command end
local function is_sound(text, at) return text:match("^%$%u%uS%d%d,00000,", at + 1) ~= nil end

function family.frame(text, at)
  if is_command(text, at) or is_sound(text, at) then return #text - at end
  local size = sonar.le(text, at, 4)
  if not size or #text - at < header + tail or not text:match("^#%u%u%u", at + 5) then return 0 end
  return size >= header + tail and size <= #text - at and size or 0
end

-- A struct of `size` bytes: fields of later versions than it has are not there.
local function show_struct(r, tree, name, size)
  if size < 1 or size > r.stop - r.at then return sonar.fault(tree, name .. ": the bytes end here") end
  local item = tree:add(family.proto, r.tvb(r.at, size), name)
  local inner, rows = sonar.reader(family, r.tvb, r.at, r.at + size), {}
  local at = 0
  for _, row in ipairs(T[name].rows) do
    at = at + sonar.size_of(row) * (row.elements or 1)
    if at <= size then table.insert(rows, row) end
  end
  r.at = r.at + size
  return sonar.walk(inner, {rows = rows}, item)
end

local function show_sized(r, tree, name)
  if r.stop - r.at < 2 then return sonar.fault(tree, name .. ": the bytes end here") end
  return show_struct(r, tree, name, r.tvb(r.at, 2):le_uint())
end

-- Those beyond the preference's number are passed over.
local function show_all(r, tree, name, count, size)
  if count * size > r.stop - r.at then return sonar.fault(tree, name .. ": the bytes end here") end
  local stop = r.at + count * size
  for _ = 1, math.min(count, sonar.proto.prefs.elements) do
    if not show_struct(r, tree, name, size) then return false end
  end
  r.at = stop
  return true
end

local function show_bytes(r, tree, field, size)
  if size > r.stop - r.at then return sonar.fault(tree, "samples: the bytes end here") end
  if size > 0 then tree:add(field, r.tvb(r.at, size)):append_text(" [" .. size .. "]") end
  r.at = r.at + size
  return true
end

-- An unsigned number of the struct of table `name` at `at`; 0 if it lies beyond what was shown.
local function number(r, at, name, row_name)
  local row = T[name].rows_by_name[row_name]
  local size = sonar.size_of(row)
  return at + row.offset + size <= r.at and r.tvb(at + row.offset, size):le_uint() or 0
end

local function show_mrz(r, tree)
  if not show_sized(r, tree, "Body") then return false end
  local ping = r.at
  if not show_sized(r, tree, "PingInfo") then return false end
  local sectors, sector_size = number(r, ping, "PingInfo", "tx_sectors"), number(r, ping, "PingInfo", "bytes_per_sector")
  if not show_all(r, tree, "TxSector", sectors, sector_size) then return false end
  local rx = r.at
  if not show_sized(r, tree, "RxInfo") then return false end
  local rx_end = r.at
  local function of_rx(row) return number({at = rx_end, tvb = r.tvb}, rx, "RxInfo", row) end
  return show_all(r, tree, "DetectionClass", of_rx("classes"), of_rx("bytes_per_class")) and
         show_all(r, tree, "Sounding", of_rx("soundings") + of_rx("extra_detections"), of_rx("bytes_per_sounding")) and
         show_bytes(r, tree, image_field, r.stop - r.at)
end

local function show_beam(r, tree, size, phase)
  local at = r.at
  if not show_struct(r, tree, "WaterBeamInfo", size) then return false end
  local samples = number(r, at, "WaterBeamInfo", "samples")
  return show_bytes(r, tree, amplitude_field, samples) and show_bytes(r, tree, phase_field, samples * phase)
end

local function show_mwc(r, tree)
  if not show_sized(r, tree, "Body") then return false end
  local tx = r.at
  if not show_sized(r, tree, "WaterTx") then return false end
  local sectors, sector_size = number(r, tx, "WaterTx", "sectors"), number(r, tx, "WaterTx", "bytes_per_sector")
  if not show_all(r, tree, "WaterSector", sectors, sector_size) then return false end
  local rx = r.at
  if not show_sized(r, tree, "WaterRx") then return false end
  local beams, size = number(r, rx, "WaterRx", "beams"), number(r, rx, "WaterRx", "bytes_per_beam")
  local phase = number(r, rx, "WaterRx", "phase")
  for _ = 1, math.min(beams, sonar.proto.prefs.elements) do
    if not show_beam(r, tree, size, math.min(phase, 2)) then return false end
  end
  return true
end

local function show_parameters(r, tree, text)
  local at = r.at
  if not show_struct(r, tree, "ParametersInfo", 6) then return false end
  local size = number(r, at, "ParametersInfo", "size") - 6
  if size < 0 or size > r.stop - r.at then return sonar.fault(tree, "text: the bytes end here") end
  if size > 0 then
    tree:add(parameters_field, r.tvb(r.at, size), sonar.printable(text:sub(r.at + 1, r.at + size)))
  end
  r.at = r.at + size
  return true
end

local function show_profile(r, tree)
  local at = r.at
  return show_sized(r, tree, "SoundProfileInfo") and
         show_all(r, tree, "SoundProfilePoint", number(r, at, "SoundProfileInfo", "points"), 20) and
         (r.stop - r.at ~= 20 or show_struct(r, tree, "SoundProfilePoint", 20))  -- one that is not counted
end

-- B of a struct without lists.
local function known_size(name)
  local size = 0
  for _, row in ipairs(T[name].rows) do size = size + sonar.size_of(row) * (row.elements or 1) end
  return size
end

local function show_text(r, tree, text)
  if r.stop > r.at then
    tree:add(parameters_field, r.tvb(r.at, r.stop - r.at), sonar.printable(text:sub(r.at + 1, r.stop)))
  end
  r.at = r.stop
  return true
end

-- What one sensor says at once, and its own sentence.
local function sensor(name)
  return function(r, tree, text)
    return show_sized(r, tree, "SensorInfo") and show_struct(r, tree, name, known_size(name)) and show_text(r, tree, text)
  end
end

local function show_depth(r, tree, text)
  local version = text:byte(r.at - header + 9)
  return sensor(version == 0 and "DepthSensor0" or "DepthSensor")(r, tree, text)
end

-- A struct that says how many samples of which size follow; what a sample has beyond the known is passed over.
local function samples(info, sample)
  return function(r, tree)
    local at = r.at
    return show_sized(r, tree, info) and
           show_all(r, tree, sample, number(r, at, info, "samples"), number(r, at, info, "bytes_per_sample"))
  end
end

local function show_headings(r, tree)
  return show_sized(r, tree, "SensorInfo") and samples("HeadingsInfo", "HeadingSample")(r, tree)
end

local function show_heave(r, tree)
  return show_sized(r, tree, "Body") and show_struct(r, tree, "Heave", known_size("Heave"))
end

-- Of datagrams that have no partition.
local infos = {
  ["#IIP"] = show_parameters, ["#IOP"] = show_parameters, ["#SVP"] = show_profile, ["#SPO"] = sensor("Position"),
  ["#CPO"] = sensor("Position"), ["#SPE"] = sensor("PositionError"), ["#SPD"] = sensor("Datum"), ["#SCL"] = sensor("Clock"),
  ["#SDE"] = show_depth, ["#SHI"] = sensor("Height"), ["#SSM"] = sensor("SoundSpeedManager"), ["#SHA"] = show_headings,
  ["#SVT"] = samples("SoundSpeedInfo", "SoundSpeedSample"), ["#SKM"] = samples("MotionInfo", "MotionSample"),
  ["#CHE"] = show_heave,
}

local function show_body(r, tree, kind, parts)
  if kind == "#FCF" then return show_sized(r, tree, "FileInfo") and show_bytes(r, tree, file_field, r.stop - r.at) end
  if parts > 1 then return show_bytes(r, tree, part_field, r.stop - r.at) end
  if kind == "#MRZ" then return show_mrz(r, tree) end
  if kind == "#MWC" then return show_mwc(r, tree) end
  return sonar.fault(tree, "no datagram that is known")
end

local function show_command(tree, range, text)
  local number_of_it, sounder, rest = text:match("^%$KSSIS,(%d+),([^,\r\n]+)(.*)")
  if sounder and sounder:find("=", 1, true) then sounder, rest = "", sounder .. rest end
  if not number_of_it or sounder:find("[^\33-\126]") then return sonar.fault(tree, "no command of a controller") or "KSSIS" end
  tree:add(command_fields[1], range, tonumber(number_of_it) % 2 ^ 32)
  tree:add(command_fields[2], range, sounder)
  tree:add(command_fields[3], range, sonar.printable(rest))
  return "KSSIS"
end

function family.display(tree, tvb, at, size, text)
  if is_command(text, at) then
    return show_command(tree, tvb(at, size), text:sub(at + 1, at + size))
  end
  if is_sound(text, at) then
    tree:add(parameters_field, tvb(at, size), sonar.printable(text:sub(at + 1, at + size)))
    return text:sub(at + 4, at + 6)
  end
  local kind = text:sub(at + 5, at + 8)
  local r = sonar.reader(family, tvb, at, at + size - tail)
  show_struct(r, tree, "Header", header)
  if infos[kind] then
    infos[kind](r, tree, text)
    if r.stop > r.at then show_bytes(r, tree, surplus_field, r.stop - r.at) end
    sonar.check(tree, "size at the end", sonar.le(text, at + size - tail, tail), size)
    return kind
  end
  if r.stop - r.at < 4 then return kind end
  local parts = tvb(r.at, 2):le_uint()
  show_struct(r, tree, "Partition", 4)
  show_body(r, tree, kind, parts)
  sonar.check(tree, "size at the end", sonar.le(text, at + size - tail, tail), size)
  return parts > 1 and kind .. " part" or kind
end

function family.sign(text) return is_command(text, 0) or is_sound(text, 0) or (family.frame(text, 0) or 0) > 0 end
