-- Packets with 0xDEADBEEF, type and size; a CRC-32 of what follows the header in types 1 and 2.
local family = sonar.families.norbit
local header, longest = 24, 2 * 1024 * 1024
local names = {[1] = "Bathymetry", [2] = "WaterColumn", [4] = "WaterColumn", [5] = "WaterColumn"}
local titles = {[4] = "Snippet", [5] = "SideScan"}
local start = "\xEF\xBE\xAD\xDE"

family.mark = "\xEF"

function family.frame(text, at)
  local seen = text:sub(at + 1, at + 4)
  if seen ~= start:sub(1, #seen) then return 0 end
  if #text - at < header then return nil end
  local kind, size, reserved = sonar.le(text, at + 4, 4), sonar.le(text, at + 8, 4), sonar.le(text, at + 16, 4)
  return names[kind] and reserved == 0 and size >= header and size <= longest and size or 0
end

function family.display(tree, tvb, at, size, text)
  local kind = sonar.le(text, at + 4, 4)
  sonar.walk(sonar.reader(family, tvb, at, at + header), family.tables.Header, tree)
  sonar.show(family, tree, names[kind], tvb, at + header, at + size)
  if kind <= 2 then sonar.check(tree, "crc", sonar.le(text, at + 20, 4), sonar.crc32(text:sub(at + header + 1, at + size))) end
  return titles[kind] or names[kind]
end

function family.sign(text) return (family.frame(text, 0) or 0) > 0 end
