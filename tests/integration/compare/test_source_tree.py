"""What fsi-compare has in the source tree alone: an installed one says so, and knows all of their names."""

import unittest

from folder_case import FolderCase

from fsi_compare import start
from fsi_compare.study import source_tree
from fsi_compare.study.catalogue import OWN
from fsi_research import studies


class Installed(FolderCase):
    """The program without compare/research."""

    main = staticmethod(start.main)

    def refusal(self, *words):
        code, out, err = self.call(*words)
        self.assertEqual((code, out, err.count("\n")), (1, "", 1), err)
        self.assertIn("belongs to this project's own research, which is not installed", err)
        self.assertIn("build in the source tree", err)
        return err

    def test_studies_of_the_source_tree(self):
        for name in source_tree.STUDIES:
            self.assertIn(f"STUDY: the study '{name}'", self.refusal("study", name, "--quick"))

    def test_kinds_of_the_source_tree(self):
        file = self.base / "mine.toml"
        for kind in source_tree.KINDS:
            file.write_text(f'title = "Mine"\nkind = "{kind}"\n')
            self.assertIn(f"kind: the kind '{kind}'", self.refusal("study", file))

    def test_commands_of_the_source_tree(self):
        for name in source_tree.COMMANDS:
            self.assertIn(f"the command {name} belongs", self.refusal(name, "--help"))
            self.assertNotIn(name, self.call("--help")[1])

    def test_its_own_study(self):
        self.assertEqual(list(OWN.ready), ["refinement"])
        self.assertEqual(self.call("study", "papre")[0], 1)


class InTheSourceTree(FolderCase):
    def test_commands(self):
        for name in source_tree.COMMANDS:
            self.assertEqual(self.call(name, "--help")[0], 0)

    def test_all_are_known(self):
        own = OWN.ready
        self.assertEqual(tuple(name for name in studies.CATALOGUE.ready if name not in own), source_tree.STUDIES)
        self.assertEqual(tuple(sorted(studies.KINDS)), source_tree.KINDS)


if __name__ == "__main__":
    unittest.main()
