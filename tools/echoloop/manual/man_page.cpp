#include <cctype>
#include <sstream>

#include "tools/echoloop/manual/manual.h"

namespace echoloop::cli::manual {
namespace {

/// Text as mdoc takes it: a new line for each sentence, none too long, and nothing that it could take for a
/// macro.
std::string prose(const std::string& text) {
    constexpr std::size_t longest = 76;
    std::string out, line, word;
    const auto end_line = [&] {
        if (line.starts_with('.') || line.starts_with('\'')) out += "\\&";
        out += line + "\n";
        line.clear();
    };
    std::istringstream words(text);
    while (words >> word) {
        const bool sentence = line.ends_with('.') && std::isupper(static_cast<unsigned char>(word[0])) != 0;
        if (!line.empty() && (sentence || line.size() + word.size() > longest)) end_line();
        line += line.empty() ? "" : " ";
        for (const char c : word) line += c == '\\' ? std::string("\\e") : std::string(1, c);
    }
    end_line();
    return out;
}

/// Lines that are typed as they are.
std::string literal(const std::string& lines) {
    std::string out = ".Bd -literal -offset indent\n";
    bool starts = true;
    std::size_t blanks = 0;
    for (const char c : lines + "\n") {
        if (starts && c == ' ' && blanks < 2) {  // the help indents them by two
            ++blanks;
            continue;
        }
        if (starts && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        starts = c == '\n';
        if (starts) blanks = 0;
    }
    return out + ".Ed\n";
}

/// Arguments of a macro: punctuation and quotes are no words of their own.
std::string word(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '-')
            out += "\\-";
        else if (c == '"')
            out += "\\(dq";
        else
            out += c;
    }
    return out;
}

std::string item(const Argument& argument) {
    std::string head = ".It ";
    if (is_option(argument)) {
        head += "Fl \\-" + word(argument.name.substr(2));
        if (argument.kind != Argument::Kind::flag) head += " Ar " + word(argument.what);
    } else {
        head += "Ar " + word(argument.name);
    }
    std::string text = argument.help;
    if (!argument.choices.empty() && argument.choices.size() > 1) {
        std::string words;
        for (const auto& choice : argument.choices) words += (words.empty() ? "" : ", ") + choice;
        text += "; one of " + words;
    }
    if (argument.required) text += " (must be given)";
    return head + "\n" + prose(text);
}

std::string section(const Verb& verb) {
    std::string out = ".Ss " + verb.name + "\n" + prose(verb.summary + ".");
    if (!verb.arguments.empty()) {
        out += ".Bl -tag -width Ds\n";
        for (const Argument& argument : verb.arguments) out += item(argument);
        out += ".El\n";
    }
    return out + ".Pp\nExamples:\n" + literal(verb.examples);
}

constexpr auto head = R"(.Dt ECHOLOOP 1
.Os
.Sh NAME
.Nm echoloop
.Nd sonar emulator with the hardware in the loop
.Sh SYNOPSIS
.Nm
.Ar verb
.Op Ar arguments
.Nm
.Fl \-help | \-version
.Sh DESCRIPTION
.Nm
is a sonar for a driver to talk to.
It renders each ping from a 3D scene (glTF), turns the echoes into levels, and
answers in the sonar's own protocol on pseudo-terminals, serial ports, TCP and
UDP.
What runs is said by a scenario, a YAML file, or by the name of one of the
examples that come with the program:
.Nm
.Cm examples
lists them.
.Sh VERBS
.Nm
.Ar verb
.Fl \-help
shows the same in a terminal.
)";

constexpr auto tail = R"(.Sh ENVIRONMENT
.Bl -tag -width Ds
.It Ev NO_COLOR
Messages have no colours.
.It Ev LP_NUM_THREADS
Threads of Mesa's rasteriser for each context; 0 if it is not set.
.It Ev NOTIFY_SOCKET , WATCHDOG_USEC
Of a service manager, which is told when the sonars are up, and then that they
are alive.
.El
.Sh FILES
.Bl -tag -width Ds
.It Pa /usr/share/echoloop/examples
Example scenarios and their scenes.
.It Pa /usr/share/echoloop/devices
Acoustic figures of every model, each with its source.
They are built into the program; these files are to read.
.It Pa /etc/echoloop/NAME.yaml
Scenario of the systemd service echoloop@NAME.
.It Pa /tmp/echoloop
Pseudo-terminals of the examples.
.El
.Sh EXIT STATUS
.Bl -tag -width Ds
.It 0
All went well.
.It 1
.Cm diff
found differences.
.It 64
Wrong usage.
.It 65
A file holds something else than it should.
.It 66
A file is missing.
.It 69
Something is not available: OpenGL, an address, a serial port.
.It 70
A fault of the program itself.
.It 71
Memory ran out.
.It 73
A file cannot be created.
.It 74
Reading or writing failed.
.It 75
With
.Fl \-fail\-late :
a ping was late, or messages or bytes were lost.
.It 77
No permission.
.It 78
The scenario is wrong; the message has file, line and column.
.El
)";

}  // namespace

std::string man_page(const std::string& date) {
    std::string out = ".Dd " + date + "\n" + head;
    for (const Verb* verb : shown_verbs()) out += section(*verb);
    return out + tail;
}

}  // namespace echoloop::cli::manual
