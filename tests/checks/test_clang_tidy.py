"""The check with clang-tidy must be able to fail, wherever in a text of several sources the mistake is."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from changed_code import changed_since, code_of
from clang_tidy import compiler_flags, groups, jobs, own_names, parted, sources_of, text_flags, text_of, touched

HERE = Path(__file__).resolve().parent
GOOD = '#include "mesh/header.hpp"\nint one(int x) { return twice(x); }\n'
# of the analyser, and of a matcher
NULL = '#include "mesh/header.hpp"\n\nint two(int* x) {\n  if (x) return twice(*x);\n  return *x;\n}\n'
POINTER = "\nint* three() { return 0; }\n"
HEADER = "#pragma once\ninline int twice(int x) { return 2 * x; }\n"


def names_of(texts: list[list[Path]]) -> list[list[str]]:
    return [[source.stem for source in text] for text in texts if text]


class ClangTidy(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name).resolve() / "tree"
        (self.root / "common/mesh").mkdir(parents=True)
        shutil.copy(HERE.parents[1] / ".clang-tidy", self.root)

    def found(self, **sources: str) -> str:
        """Findings of common/mesh/NAME.cpp for each name, or of common/FOLDER/NAME.cpp for FOLDER__NAME."""
        compiler = os.environ.get("CXX", "c++")
        (self.root / "common/mesh/header.hpp").write_text(HEADER)
        commands = []
        for name, text in sources.items():
            folder, name = name.split("__") if "__" in name else ("mesh", name)
            file = self.root / f"common/{folder}/{name}.cpp"
            file.parent.mkdir(exist_ok=True)
            file.write_text(text)
            command = f"{compiler} -I{self.root}/common -std=c++17 -o {name}.o -c {file}"
            commands.append({"directory": str(self.root), "file": str(file), "command": command})
        (self.root / "compile_commands.json").write_text(json.dumps(commands))
        flags = compiler_flags(self.root, compiler)
        texts = groups(flags, sources_of(self.root, flags))
        self.assertEqual(sorted(source for text in texts for source in text), sources_of(self.root, flags))
        self.texts = names_of(texts)
        program = os.environ.get("CLANG_TIDY", "clang-tidy")
        self.parts = names_of(parted(program, self.root, flags, texts[0]))
        return "\n".join(
            found for job in jobs(program, self.root, flags, sources_of(self.root, flags)) if (found := job())
        )

    def test_nothing_is_found_in_a_clean_tree(self) -> None:
        self.assertEqual(self.found(a=GOOD, b=GOOD.replace("one", "other")), "")

    def test_comments_are_no_code(self) -> None:
        self.assertEqual(code_of('a("//"); // b\nc /* d */ e'), ["a(", '"//"', ");", "c", "e"])
        self.assertEqual(code_of("x = '\"'; // b"), ["x", "=", "'\"'", ";"])
        self.assertEqual(code_of('R"x(// a)" )x" // b'), ['R"x(// a)" )x"'])
        self.assertEqual(code_of("1'000 // a\n+ 2'000"), ["1'000", "+", "2'000"])
        self.assertNotEqual(code_of("a // NOLINT(x)"), code_of("a // b"))
        self.assertEqual(code_of("a  (b)\n;"), code_of("a (b) ; // c"))

    def test_blanks_in_strings_and_the_ends_of_macros_are_code(self) -> None:
        self.assertNotEqual(code_of('"a b"'), code_of('"a  b"'))
        self.assertNotEqual(code_of('R"(a = 1\nb = 2)"'), code_of('R"(a = 1 b = 2)"'))
        self.assertNotEqual(code_of("#define A 1\nint x;"), code_of("#define A 1 int x;"))
        self.assertEqual(code_of("#define A 1  // b\nint x;"), code_of("#define A 1\n\nint x;"))

    def test_what_has_changed_since_a_commit(self) -> None:
        def git(*words: str) -> str:
            who = ["-c", "user.name=a", "-c", "user.email=a@b"]
            return subprocess.run(["git", "-C", str(self.root), *who, *words], capture_output=True, text=True).stdout

        self.found(a=GOOD, b="int two();\n", c="int three();\n")
        git("init", "-q")
        git("add", "-A")
        git("commit", "-q", "-m", "first")
        record = self.root.parent / "record.txt"
        record.write_text(git("rev-parse", "HEAD") + "A commit.\n")
        sources = sorted((self.root / "common/mesh").glob("*.cpp"))

        def names() -> list[str]:
            changed = changed_since(self.root, record)
            return [source.stem for source in touched(self.root, sources, changed or set())]

        self.assertEqual(names(), [])
        (self.root / "common/mesh/b.cpp").write_text("/* Both\n of them. */\nint\ntwo();  // said at last\n")
        self.assertEqual(names(), [], "comments and line breaks alone")
        (self.root / "common/mesh/b.cpp").write_text("int two();  // NOLINT\n")
        self.assertEqual(names(), ["b"], "a comment that silences a finding")
        (self.root / "common/mesh/b.cpp").write_text("int two(int);\n")
        self.assertEqual(names(), ["b"])
        (self.root / "common/mesh/header.hpp").write_text(HEADER + "inline int thrice(int x) { return 3 * x; }\n")
        self.assertEqual(names(), ["a", "b"])
        # Of a header that headers alone include one source is enough.
        (self.root / "common/mesh/header.hpp").write_text('#include "mesh/inner.hpp"\n' + HEADER)
        (self.root / "common/mesh/inner.hpp").write_text("#pragma once\n")
        for name in ("c", "d"):
            (self.root / f"common/mesh/{name}.cpp").write_text(GOOD.replace("one", name))
        git("add", "-A")
        git("commit", "-q", "-m", "second")
        record.write_text(git("rev-parse", "HEAD") + "A commit.\n")
        sources = sorted((self.root / "common/mesh").glob("*.cpp"))
        self.assertEqual(names(), [])
        (self.root / "common/mesh/inner.hpp").write_text("#pragma once\ninline int zero() { return 0; }\n")
        self.assertEqual(names(), ["a"])
        (self.root / "common/mesh/d.cpp").write_text(GOOD)
        self.assertEqual(names(), ["d"], "it reaches the header, too")
        record.write_text("0123456789012345678901234567890123456789\n")
        self.assertIsNone(changed_since(self.root, record), "a commit that the clone does not have")

    def test_a_finding_is_told_with_its_own_file_and_line(self) -> None:
        found = self.found(a=GOOD, b=NULL, c=POINTER)
        self.assertIn("common/mesh/b.cpp:5:", found)
        self.assertIn("clang-analyzer-core.NullDereference", found)
        self.assertIn("common/mesh/c.cpp:2:", found)
        self.assertIn("modernize-use-nullptr", found)

    def test_a_finding_in_a_header(self) -> None:
        mistake = "inline int* nowhere() { return 0; }\n"
        (self.root / "common/mesh/other.hpp").write_text("#pragma once\n" + mistake)
        self.assertIn("other.hpp:2:", self.found(a=GOOD, b='#include "mesh/other.hpp"\n'))

    def test_one_name_of_two_things_hides_no_finding(self) -> None:
        local = "namespace {\nconstexpr int size = 2;\n}  // namespace\n"
        found = self.found(a=local + "int a() { return size; }\n", b=local + NULL)
        self.assertEqual(self.texts, [["b"], ["a"]])
        self.assertIn("common/mesh/b.cpp:8:", found)
        self.assertNotIn("redefinition", found)

    def test_one_name_of_two_things_that_is_seen_by_the_compiler_only_hides_no_finding(self) -> None:
        local = "namespace {\nconstexpr int size = 2;\n}\n"
        found = self.found(a=local + "int a() { return size; }\n", b=local + NULL)
        self.assertEqual(self.texts, [["a", "b"]])
        self.assertEqual(sorted(self.parts), [["a"], ["b"]])
        self.assertIn("common/mesh/b.cpp:8:", found)
        self.assertNotIn("redefinition", found)

    def test_names_of_its_own(self) -> None:
        file = self.root / "common/mesh/a.cpp"
        file.write_text(
            "int none();\nnamespace {\nconstexpr double size = 2;\nstruct Part {\n  int member = 0;\n};\n"
            "template <int n>\nstd::vector<int> list(int given) {\n  int local = given;\n  return {local};\n}\n"
            "using Name = int;\n}  // namespace\nint other() { return 1; }\n"
        )
        self.assertEqual(own_names(file), {"Part", "size", "list(int given) {", "Name"})

    def test_one_name_of_two_things_in_two_folders_hides_no_finding(self) -> None:
        local = "namespace {\nconstexpr int size = 2;\n}\n"
        found = self.found(a=local + "int a() { return size; }\n", b=POINTER, other__c=local + POINTER)
        self.assertIn("common/mesh/b.cpp:2:", found)
        self.assertIn("common/other/c.cpp:5:", found)
        self.assertNotIn("redefinition", found)

    def test_a_name_that_a_later_header_has_as_well_hides_no_finding(self) -> None:
        (self.root / "common/mesh/state.hpp").write_text(
            "#pragma once\nnamespace fsi {\nstruct State {};\nvoid use(State s);\n}\n"
        )
        own = (
            "namespace fsi {\nnamespace {\nstruct State {};\nState made() { return {}; }\n}\nvoid a() { made(); }\n}\n"
        )
        found = self.found(a=own, b='#include "mesh/state.hpp"\n' + POINTER, c=POINTER.replace("three", "four"))
        self.assertIn("common/mesh/b.cpp:3:", found)
        self.assertIn("common/mesh/c.cpp:2:", found)
        self.assertNotIn("ambiguous", found)

    def test_only_the_source_that_is_in_the_way_of_others_stands_apart(self) -> None:
        (self.root / "common/mesh/state.hpp").write_text("#pragma once\nnamespace fsi {\nstruct State {};\n}\n")
        own = "namespace fsi {\nnamespace {\nstruct State {};\n}\nint a() { return sizeof(State); }\n}\n"
        other = '#include "mesh/state.hpp"\nnamespace fsi {{\nvoid {}(State& s) {{ s = State(); }}\n}}\n'
        self.assertEqual(self.found(a=own, **{name: other.format(name) for name in "bcd"}), "")
        self.assertEqual(self.parts, [["b", "c", "d"], ["a"]])

    def test_a_header_is_looked_for_beside_its_source(self) -> None:
        (self.root / "common/other").mkdir()
        (self.root / "common/other/beside.hpp").write_text("#pragma once\ninline int here() { return 1; }\n")
        self.assertEqual(self.found(a=GOOD, other__b='#include "beside.hpp"\nint b() { return here(); }\n'), "")

    def test_a_name_that_hides_another(self) -> None:
        hides = "int a(int x) {\n  if (x > 0) {\n    const int x = 3;\n    return x;\n  }\n  return x;\n}\n"
        found = self.found(a=hides, b="int x = 1;\n")
        self.assertIn("common/mesh/a.cpp:3:", found)
        self.assertIn("clang-diagnostic-shadow", found)
        other = self.found(a="int x = 1;\n", b="int b() {\n  const int x = 3;\n  return x;\n}\n")
        self.assertEqual(other, "", "what is so of several sources as one text is not so of each alone")

    def test_a_header_that_only_another_source_includes(self) -> None:
        found = self.found(a=GOOD, b="int b() { return twice(2); }\n")
        self.assertIn("common/mesh/b.cpp:1:", found)
        self.assertIn("clang-diagnostic-error", found)

    def test_what_does_not_compile(self) -> None:
        self.assertIn("common/mesh/b.cpp:1:", self.found(a=GOOD, b="int broken( {\n"))

    def test_an_include_twice_in_one_source_is_found(self) -> None:
        found = self.found(a=GOOD, b='#include "mesh/header.hpp"\n' + GOOD.replace("one", "other"))
        self.assertIn("common/mesh/b.cpp:2:", found)
        self.assertIn("readability-duplicate-include", found)

    def test_sources_with_other_flags_make_a_text_of_their_own(self) -> None:
        files = [self.root / f"common/mesh/{name}.cpp" for name in "abc"]
        for file in files:
            file.write_text(GOOD)
        flags = {str(file): ["c++"] for file in files}
        for other in ("-DFSI_OTHER", "-frounding-math"):
            flags[str(files[1])] = ["c++", other]
            self.assertEqual(sorted(groups(flags, sources_of(self.root, flags))), [[files[0], files[2]], [files[1]]])

    def test_sources_that_know_other_libraries_share_a_text(self) -> None:
        files = [self.root / f"common/mesh/{name}.cpp" for name in "abc"]
        for file in files:
            file.write_text(GOOD)
        flags = {str(file): ["c++", "-isystem", "one", "-O3"] for file in files}
        flags[str(files[1])] = ["c++", "-isystem", "two", "-isystem", "one", "-O2", "-DTHEIRS"]
        self.assertEqual(groups(flags, sources_of(self.root, flags)), [files])
        self.assertEqual(
            text_flags(flags, files), ["c++", "-isystem", "one", "-O3", "-isystem", "two", "-O2", "-DTHEIRS"]
        )

    def test_lines_keep_their_places(self) -> None:
        file = self.root / "common/mesh/a.cpp"
        file.write_text(GOOD)
        text, places = text_of([file, file])
        self.assertEqual(len(text.split("\n")) - 1, len(places))
        self.assertEqual(text.count("#include"), 1)
        self.assertEqual(places[4], (file, 2))


if __name__ == "__main__":
    unittest.main()
