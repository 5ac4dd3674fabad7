-- Messages of a 16-byte header with 0x1601, type, command and size.
local family = sonar.families.edgetech
local header, longest = 16, 262144
local T = family.tables
local start = "\x01\x16"
local names = {[22] = "SystemTime", [426] = "SystemTime", [25] = "Setting", [83] = "Setting", [120] = "Setting",
               [121] = "Setting", [125] = "Setting", [128] = "Setting", [133] = "Setting", [141] = "Setting",
               [129] = "Coupling", [80] = "SonarData", [82] = "OldSideScan", [182] = "SystemInformation",
               [2002] = "NmeaText", [2020] = "PitchRoll", [2060] = "Pressure"}
local exact = {SystemTime = true, Setting = true, Coupling = true, PitchRoll = true}
local titles = {[22] = "SystemTime", [23] = "TimeDelta", [25] = "Shutdown", [41] = "Alive", [80] = "SonarData",
                [82] = "OldSideScan", [83] = "DataActive", [120] = "Ping", [121] = "PingGain", [125] = "Trigger",
                [128] = "Range", [129] = "Coupling", [133] = "PulseSelect", [141] = "GainControl",
                [182] = "SystemInformation", [426] = "FileTime", [428] = "Padding", [2002] = "NmeaText",
                [2020] = "PitchRoll", [2060] = "Pressure", [2080] = "DopplerLog", [2090] = "Situation",
                [2091] = "Situation2"}

local function fixed_part(name)
  local size = 0
  for _, row in ipairs(T[name].rows) do
    if row.kind ~= "rest" then size = size + sonar.size_of(row) * (row.elements or 1) end
  end
  return size
end

family.mark = start:sub(1, 1)

function family.frame(text, at)
  local seen = text:sub(at + 1, at + #start)
  if seen ~= start:sub(1, #seen) then return 0 end
  if #text - at < header then return nil end
  local version, command, reserved, size =
    sonar.le(text, at + 2, 1), sonar.le(text, at + 6, 1), sonar.le(text, at + 10, 2), sonar.le(text, at + 12, 4)
  local good = version >= 1 and version <= 0x20 and command <= 3 and reserved == 0 and size <= longest - header
  return good and header + size or 0
end

-- The table of what follows the header: bytes alone where that does not fit its type.
local function table_of(text, at, size)
  local name = names[sonar.le(text, at + 4, 2)]
  if not name or sonar.le(text, at + 6, 1) == 1 then return "Unread" end
  local least = fixed_part(name)
  local fits = exact[name] and size == least or not exact[name] and size >= least
  return fits and name or "Unread"
end

function family.display(tree, tvb, at, size, text)
  local kind = sonar.le(text, at + 4, 2)
  sonar.walk(sonar.reader(family, tvb, at, at + header), T.Header, tree)
  sonar.show(family, tree, table_of(text, at, size - header), tvb, at + header, at + size)
  return titles[kind] or "message " .. kind
end

function family.sign(text)
  return (family.frame(text, 0) or 0) > 0 and titles[sonar.le(text, 4, 2)] ~= nil
end
