-- Packets AA 10 01 with two sizes that agree and a sum; behind the header a command, an answer or a ping.
local family = sonar.families.wayfinder
local start, header, sum_size, longest = "\xAA\x10\x01", 9, 2, 33000
-- By the command's number: the table, and how many bytes it has; by these too where a command has two.
local commands = {[0x1F000002] = {[16] = "SetTime"}, [0x87000002] = {[24] = "SetSetup", [20] = "SetOlderSetup"},
                  [0x86000003] = {[8] = "SetSoundSpeed"}}
local answers = {[0x1D000001] = {[18] = "TimeResponse"}, [0x85000001] = {[26] = "SetupResponse"},
                 [0x81000001] = {[141] = "SystemResponse"}, [0x10000001] = {[13] = "FeaturesResponse"},
                 [0x19000001] = {[18] = "TestsResponse"}, [0x81000003] = {[141] = "ComponentsResponse"}}
local structures = {SetTime = 0x23, SetSetup = 0x22, SetOlderSetup = 0x22, TimeResponse = 0x23, SetupResponse = 0x22,
                    SystemResponse = 0x21, FeaturesResponse = 0x26, TestsResponse = 0x24, ComponentsResponse = 0x29}

family.mark = "\xAA"

function family.frame(text, at)
  local seen = text:sub(at + 1, at + #start)
  if seen ~= start:sub(1, #seen) then return 0 end
  if text:byte(at + 6) and text:byte(at + 6) ~= 2 then return 0 end
  if #text - at < 5 then return nil end
  local size = sonar.le(text, at + 3, 2)
  if size < header + sum_size or size > longest then return 0 end
  if #text - at < header then return nil end
  return sonar.le(text, at + 7, 2) + 7 == size and size or 0
end

function family.good(text, at, size)
  return sonar.le(text, at + size - sum_size, 2) == sonar.sum(text:sub(at + 1, at + size - sum_size)) % 0x10000
end

local function table_of(text, at, size)
  local kind, body = text:byte(at + 7), size - header - sum_size
  if kind == 5 then
    return body == 87 and text:sub(at + header + 1, at + header + 2) == "\xAA\x11" and "Data" or "Other"
  end
  local known = kind == 3 and commands or kind == 4 and answers
  if not known then return "Other" end
  local plain, structure_at = kind == 3 and "Command" or "Response", at + header + (kind == 3 and 4 or 6)
  if kind == 4 and body == 6 then return "Refusal" end
  local name = (known[sonar.le(text, at + header, 4)] or {})[body]
  if not name or structures[name] and text:byte(structure_at + 1) ~= structures[name] then return plain end
  return name
end

function family.display(tree, tvb, at, size, text)
  sonar.show(family, tree, "Header", tvb, at, at + header)
  local name = table_of(text, at, size)
  sonar.show(family, tree, name, tvb, at + header, at + size - sum_size)
  return name
end

function family.is_sure(text, at, size) return family.good(text, at, size) end

function family.sign(text)
  local size = family.frame(text, 0) or 0
  return size > 0 and size <= #text and family.is_sure(text, 0, size)
end
