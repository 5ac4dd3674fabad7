-- Blue Robotics' messages; a message that no Ping device has is a Cerulean sonar's.
local family = sonar.families.ping
local names = sonar.names_by_id(family)

sonar.use_ping_frames(family)
family.sign = sonar.begins_as_ping

function family.display(...) return sonar.show_ping(family, names, ...) end

function family.other(text, at, size)
  local cerulean = sonar.families.cerulean
  return cerulean.is_own(text, at, size) and cerulean or nil
end
