"""Messages: one line that any terminal can show, of parts that are not too long."""

import contextlib
import io
import unittest

import synthetic  # noqa: F401: the package's folder onto the path

from fsi_compare import start
from fsi_compare.base.errors import InputError, ProgramError, printable, shortened, shortened_path


class Messages(unittest.TestCase):
    def test_control_characters_are_escaped(self):
        for text, shown in (
            ("a\x1b[31mb", "a\\x1b[31mb"),
            ("a\nb\tc", "a\\nb\\tc"),
            ("\u202e", "\\u202e"),
            (b"\xff".decode("utf-8", "surrogateescape"), "\\xff"),
            ("Größe 3 µm", "Größe 3 µm"),
        ):
            self.assertEqual(printable(text), shown)
            self.assertEqual(printable(printable(text)), shown)

    def test_long_parts_are_shortened(self):
        self.assertEqual(shortened("abcdefghij", 10), "abcdefghij")
        self.assertEqual(shortened("abcdefghijk", 10), "abcd...ijk")
        self.assertEqual(shortened_path("abcdefghijk", 10), "...efghijk")
        text = str(InputError("f" * 5000, "k" * 5000, "p" * 5000, "r" * 5000))
        self.assertEqual(len(text), 200 + 2 + 200 + 2 + 600 + 2 + 2000)

    def test_parts(self):
        self.assertEqual(str(InputError("f", "", "p\n q", "r")), "f: p q; r")
        self.assertEqual(str(ProgramError("f", "k", "a: b: c; d", "r")), "f: k: a: b: c; d; r")

    def test_out_of_memory_each_command_has_its_own_advice(self):
        def said(*words):
            def fails(arguments, version):
                raise MemoryError

            with contextlib.redirect_stderr(io.StringIO()) as err:
                self.assertEqual(start.main(list(words), "0", load=lambda: fails), 1)
            return err.getvalue()

        self.assertIn("compare fewer or smaller runs", said("pressure", "a", "b"))
        self.assertIn("--coarser", said("verify", "case.toml"))
        self.assertIn("--frames", said("report", "a"))
        self.assertNotIn("compare fewer", said("verify", "case.toml") + said("convert-mesh", "a") + said("tune", "a"))


if __name__ == "__main__":
    unittest.main()
