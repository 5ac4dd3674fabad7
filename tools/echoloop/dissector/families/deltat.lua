-- 83P says its size, EC has always the same.
local family = sonar.families.deltat
local control_bytes, least = sonar.fixed_size(family.tables, family.tables.EC), 256
family.mark = "[8E]"

function family.frame(text, at)
  local start = text:sub(at + 1, at + 3)
  if start:sub(1, 2) == "EC" then return control_bytes end
  if start == "E" or (#start < 3 and ("83P"):sub(1, #start) == start) then return nil end
  if start ~= "83P" then return 0 end
  local size = sonar.be(text, at + 4, 2)
  if not size then return nil end
  return size >= least and size or 0
end

function family.display(tree, tvb, at, size, text)
  return sonar.show(family, tree, text:sub(at + 1, at + 1) == "E" and "EC" or "83P", tvb, at, at + size)
end

-- Two letters are no sure sign: what follows must be codes that there are.
function family.sign(text)
  if text:sub(1, 3) == "83P" then return family.frame(text, 0) == #text end
  if text:sub(1, 2) ~= "EC" or #text ~= control_bytes then return false end
  local T = family.tables.EC.rows_by_name
  local function code(row) return text:byte(T[row].offset + 1) end
  return code("id") == 0 and code("range") >= 2 and code("range") <= 14 and code("sector") <= 3 and code("beams") <= 2
end
