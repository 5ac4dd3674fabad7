-- TSS1 lines and the ten bytes of EM Attitude 3000, as protocols/motion/reading.h has them.
local family = sonar.families.motion
local tss1, em = family.tables.Tss1.rows_by_name, family.tables.EmAttitude3000.rows_by_name
local tss1_size, em_size, sync = 27, 10, 0x90
local shape = "^:(%x%x)(%x%x%x%x) ([ -]%d%d%d%d)([uUgGhHfF])([ -]%d%d%d%d) ([ -]%d%d%d%d)\r\n"

family.mark = "[:\x90-\xAF]"

local function is_status(byte) return byte and byte >= 0x90 and byte <= 0xAF end

local function may_begin(text, at)
  local first, second = text:byte(at + 1, at + 2)
  return not first or first == 0x3A or is_status(first) and (not second or second == sync)
end

local function word(text, at)
  local low, high = text:byte(at + 1, at + 2)
  return low + 256 * high
end

local function signed(text, at)
  local value = word(text, at)
  return value < 32768 and value or value - 65536
end

local function valid(text, at)
  return math.abs(signed(text, at + 2)) <= 17999 and math.abs(signed(text, at + 4)) <= 17999
    and math.abs(signed(text, at + 6)) <= 999 and word(text, at + 8) < 36000
end

function family.frame(text, at)
  local left = #text - at
  if text:byte(at + 1) == 0x3A then
    if left < tss1_size then return nil end
    return text:match(shape, at + 1) and tss1_size or 0
  end
  if not is_status(text:byte(at + 1)) or not may_begin(text, at) then return 0 end
  if left < em_size then return nil end
  return valid(text, at) and may_begin(text, at + em_size) and em_size or 0
end

local function hundredths(text) return tonumber((text:gsub(" ", ""))) / 100 end

function family.display(tree, tvb, at, _, text)
  local function show(row, from, size, value)
    local item = tree:add(row.field, tvb(at + from, size), value)
    if row.unit then item:append_text(" " .. row.unit) end
  end
  if text:byte(at + 1) == 0x3A then
    local horizontal, vertical, heave, status, roll, pitch = text:match(shape, at + 1)
    local up = tonumber(vertical, 16)
    show(tss1.horizontal, 1, 2, tonumber(horizontal, 16) * 0.0383)
    show(tss1.vertical, 3, 4, (up < 32768 and up or up - 65536) * 0.000625)
    show(tss1.heave, 8, 5, hundredths(heave))
    show(tss1.roll, 14, 5, hundredths(roll))
    show(tss1.pitch, 20, 5, hundredths(pitch))
    show(tss1.status, 13, 1, status)
    return "Tss1"
  end
  show(em.status, 0, 1, text:byte(at + 1))
  show(em.roll, 2, 2, signed(text, at + 2) / 100)
  show(em.pitch, 4, 2, signed(text, at + 4) / 100)
  show(em.heave, 6, 2, signed(text, at + 6) / 100)
  show(em.heading, 8, 2, word(text, at + 8) / 100)
  return "EmAttitude3000"
end

-- Ten bytes may be anybody's.
function family.is_sure(text, at) return text:byte(at + 1) == 0x3A end

function family.sign(text)
  return family.frame(text, 0) == #text
end
