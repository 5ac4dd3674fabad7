# Writes OUT, a C++ file that holds the page's files. A string literal of C++ may hold 64 KiB only, so long files are
# joined from pieces.
function(part path type file)
    file(READ ${file} text)
    string(LENGTH "${text}" length)
    set(pieces "")
    set(from 0)
    while(from LESS length)
        string(SUBSTRING "${text}" ${from} 16000 piece)
        string(APPEND pieces "std::string(R\"page(${piece})page\") + ")
        math(EXPR from "${from} + 16000")
    endwhile()
    set(parts "${parts}        {\"${path}\", \"${type}\", ${pieces}\"\"},\n" PARENT_SCOPE)
endfunction()
set(parts "")
part("/" "text/html; charset=utf-8" ${PAGE}/index.html)
part("/style.css" "text/css; charset=utf-8" ${PAGE}/style.css)
part("/app.js" "text/javascript; charset=utf-8" ${BUNDLE})
file(WRITE ${OUT} "#include \"tools/view/page.h\"

namespace echoloop::view {

const PagePart* find_page_part(std::string_view path) {
    static const PagePart parts[] = {
${parts}    };
    for (const PagePart& part : parts)
        if (part.path == path) return &part;
    return nullptr;
}

}  // namespace echoloop::view
")
