# cmake -D FROM=file -D TO=file.cpp -P embed.cmake: a text file as the function dottrack_dbc().
file(READ "${FROM}" text)
string(REGEX REPLACE ".*/" "" name "${FROM}")
file(WRITE "${TO}" "// ${name}, as a string.\n#include \"app/workstation/dbc/dottrack_dbc.h\"\n
namespace dottrack::dbc {\n
std::string_view dottrack_dbc() {
  return R\"DBC(${text})DBC\";
}\n
}  // namespace dottrack::dbc\n")
