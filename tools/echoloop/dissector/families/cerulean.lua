-- Messages of their own in frames of the Ping protocol; ids 1200 to 1213 are other messages than a Ping1D's.
local family, ping = sonar.families.cerulean, sonar.families.ping
local names, ping_names = sonar.names_by_id(family), sonar.names_by_id(ping)
local common = 6  -- up to this id messages are those of all devices, and in the other family's tables
local processor_temperature, overhead = 1213, 10
local own = {}
for _, id in ipairs({10, 14, 15, 17, 116, 118, 504, 1015, 1223, 1308, 2197, 2198, 3011, 3012, 3023}) do own[id] = true end

sonar.use_ping_frames(family)

function family.is_own(text, at, size)
  local id = sonar.le(text, at + 4, 2)
  return own[id] or (id == processor_temperature and size - overhead == 4)
end

family.is_sure = family.is_own

function family.display(tree, tvb, at, size, text)
  local shared = sonar.le(text, at + 4, 2) <= common
  return sonar.show_ping(shared and ping or family, shared and ping_names or names, tree, tvb, at, size, text)
end

function family.sign(text) return sonar.begins_as_ping(text) and family.is_own(text, 0, family.frame(text, 0)) end
