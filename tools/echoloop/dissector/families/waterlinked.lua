-- JSON as text, sentences 'w' to the line's end, lines of PD6 ':' and two capitals, PD4 blocks of 47 bytes.
local family = sonar.families.waterlinked
local T = family.tables
local longest_line, longest_json, block = 512, 65536, 47
local block_head = "}\0\45\0"
local other_field = sonar.text_field("sonar.waterlinked.field", "field", "of a message without a table")
local sum_field = ProtoField.uint8("sonar.waterlinked.checksum", "checksum", base.HEX, nil, 0, "CRC-8 of the characters")
for _, field in ipairs({other_field, sum_field}) do table.insert(family.fields, field) end

family.mark = "[{%[w:}]"

-- Bytes of the object or array at `at`, from the end of which a line end is not counted; nil: not whole.
local function json_size(text, at)
  local depth, place = 0, at + 1
  while place <= #text do
    local c = text:sub(place, place)
    if c == '"' then
      repeat
        place = text:find('["\\]', place + 1)
        if not place then return nil end
        local escaped = text:sub(place, place) == "\\"
        if escaped then place = place + 1 end
      until not escaped
    elseif c == "{" or c == "[" then
      depth = depth + 1
    elseif c == "}" or c == "]" then
      depth = depth - 1
      if depth <= 0 then return place - at end
    end
    place = place + 1
  end
  return nil
end

local function line_end(text, at) return #(text:match("^\r?\n", at + 1) or text:match("^\r", at + 1) or "") end

local function is_sentence(line)
  local head, rest = line:match("^(w[cr][%a?!])(.*)$")
  return head and not head:match("^wc[?!]") and (rest == "" or rest:match("^,[^*]*$") or rest:match("^,?[^*]*%*%x%x$")) and true or false
end

local function is_pd6(line) return line:match("^:%u%u,") ~= nil end

function family.frame(text, at)
  local first = text:sub(at + 1, at + 1)
  if first == "{" or first == "[" then
    local size = json_size(text, at)
    if size then return size + line_end(text, at + size) end
    return #text - at >= longest_json and 0 or nil
  elseif first == "}" then
    local seen = text:sub(at + 1, at + 4)
    return seen == block_head:sub(1, #seen) and (#seen < 4 and #text - at < block and nil or block) or 0
  elseif first == "w" or first == ":" then
    local line = text:match("^[ -~]*", at + 1)
    if #line > longest_line then return 0 end
    local ended = line_end(text, at + #line)
    if ended == 0 then
      if #text - at == #line then return is_sentence(line) and line:match("%*%x%x$") and #line or nil end
      return 0
    end
    return (is_sentence(line) or is_pd6(line)) and #line + ended or 0
  end
  return 0
end

local function crc_of(text)
  local crc = 0
  for i = 1, #text do
    crc = bit.bxor(crc, text:byte(i))
    for _ = 1, 8 do
      crc = bit.lshift(crc, 1)
      if crc > 0xFF then crc = bit.bxor(crc, 0x107) end
    end
  end
  return crc
end

local function show_value(tree, row, range, value) sonar.show_word(tree, row, range, value, other_field) end
local function show_list(tree, tvb, from, text, tab) sonar.show_list(tree, tvb, from, text, tab, other_field) end

local function members(text)
  local out, place = {}, text:match("^{%s*()")
  while place do
    local key, from = text:match('^"([^"]*)"%s*:%s*()', place)
    if not key then break end
    local first, size = text:sub(from, from), nil
    if first == '"' then
      size = #(text:match('^"[^"\\]*"', from) or "")
    elseif first == "{" or first == "[" then
      size = json_size(text, from - 1) or 0
    else
      size = #text:match("^[%w+.-]*", from)
    end
    if size == 0 then break end
    table.insert(out, {key = key, at = from, value = text:sub(from, from + size - 1)})
    place = text:match("^%s*,%s*()", from + size)
  end
  return out
end

local function bare(value) return value:match('^"(.*)"$') or value end

local function name_of(list)
  local found = {}
  for _, member in ipairs(list) do found[member.key] = bare(member.value) end
  if found.type and T[found.type] and found.type ~= "command" then return found.type end
  return found.command and "command" or found.response_to and "response" or "object"
end

local function show_json(tree, tvb, at, text)
  local list = members(text)
  local name = name_of(list)
  for _, member in ipairs(list) do
    local row = T[name] and T[name].rows_by_name[member.key]
    show_value(tree, row, tvb(at + member.at - 1, #member.value), bare(member.value))
  end
  return name
end

local function show_sentence(tree, tvb, at, line)
  local name, body, sum = line:sub(1, 3), line:match("^([^*]*)%*(%x%x)$")
  body = body or line
  if #body > 4 then show_list(tree, tvb, at + 4, body:sub(5), T[name]) end
  if sum then
    local item = tree:add(sum_field, tvb(at + #line - 2, 2), tonumber(sum, 16))
    sonar.check(item, "checksum", tonumber(sum, 16), crc_of(body))
  end
  return name
end

function family.display(tree, tvb, at, size, text)
  local first = text:sub(at + 1, at + 1)
  if first == "{" or first == "[" then
    return show_json(tree, tvb, at, text:sub(at + 1, at + size):match("^(.-)[\r\n]*$"))
  elseif first == "}" then
    sonar.show(family, tree, "PD4", tvb, at, at + size)
    sonar.check(tree, "checksum", sonar.le(text, at + size - 2, 2), sonar.sum(text:sub(at + 1, at + size - 2)) % 0x10000)
    return "PD4"
  end
  local line = text:sub(at + 1, at + size):match("^[^\r\n]*")
  if first == "w" then return show_sentence(tree, tvb, at, line) end
  show_list(tree, tvb, at + 4, line:sub(5), T[line:sub(2, 3)])
  return line:sub(2, 3)
end

function family.sign(text)
  local size = family.frame(text, 0) or 0
  if size == 0 or size > #text then return false end
  local first, whole = text:sub(1, 1), text:sub(1, size)
  if first == "{" then return name_of(members(whole)) ~= "object" end
  if first == "}" then return sonar.le(text, size - 2, 2) == sonar.sum(text:sub(1, size - 2)) % 0x10000 end
  if first == ":" then return T[whole:sub(2, 3)] ~= nil end
  local body, sum = whole:match("^([^*]*)%*(%x%x)\r?\n?$")
  return body ~= nil and tonumber(sum, 16) == crc_of(body)
end

function family.is_sure(text, at, size) return family.sign(text:sub(at + 1, at + size)) end
