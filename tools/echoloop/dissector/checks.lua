-- Sums that tables cannot say. A sum that does not fit is a fault. `bit` is Wireshark's own, with signed results; Lua 5.4,
-- from Wireshark 4.4 on, has no bit32.
local crc_table = {}
for i = 0, 255 do
  local c = i
  for _ = 1, 8 do c = bit.bxor(bit.rshift(c, 1), c % 2 == 1 and 0xEDB88320 or 0) end
  crc_table[i] = c
end

-- CRC-32 of IEEE 802.3.
function sonar.crc32(text)
  local c = 0xFFFFFFFF
  for i = 1, #text do c = bit.bxor(crc_table[bit.band(bit.bxor(c, text:byte(i)), 0xFF)], bit.rshift(c, 8)) end
  return bit.bnot(c) % 0x100000000
end

function sonar.sum(text)
  local sum = 0
  for i = 1, #text do sum = sum + text:byte(i) end
  return sum
end

function sonar.check(tree, what, said, made)
  if said ~= made then sonar.fault(tree, ("%s: the bytes make 0x%x"):format(what, made)) end
end

-- A number of `count` bytes at `at` (from 0) of a string; nil if they are not there.
function sonar.le(text, at, count)
  if at < 0 or at + count > #text then return nil end
  local value = 0
  for i = count, 1, -1 do value = value * 256 + text:byte(at + i) end
  return value
end
function sonar.be(text, at, count)
  if at < 0 or at + count > #text then return nil end
  local value = 0
  for i = 1, count do value = value * 256 + text:byte(at + i) end
  return value
end
