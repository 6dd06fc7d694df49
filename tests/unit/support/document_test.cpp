#include "littoral/support/config.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

std::string refusal(const std::string& text) {
  return message_of<ConfigError>([&] { Document::from_text(text, "scene.yaml"); });
}

TEST(DocumentTest, MissingFile) {
  EXPECT_EQ(message_of<ConfigError>([] { Document::from_file("no/such.yaml"); }),
            "no/such.yaml: cannot open: No such file or directory.");
}

TEST(DocumentTest, Folder) {
  const TemporaryFolder folder;
  EXPECT_CONTAINS(message_of<ConfigError>([&] { Document::from_file(folder / ""); }), "is a folder");
}

TEST(DocumentTest, Empty) {
  EXPECT_CONTAINS(refusal(""), "scene.yaml: the file is empty");
  EXPECT_CONTAINS(refusal("# only a comment\n"), "scene.yaml: the file is empty");
  EXPECT_CONTAINS(refusal("~"), "the file is empty");
}

TEST(DocumentTest, NoMapAtTheTop) {
  EXPECT_CONTAINS(refusal("- a\n- b\n"),
                  "scene.yaml: holds a list of 2 at the top. Expected keys and values");
  EXPECT_CONTAINS(refusal("hello"), "scene.yaml: holds 'hello' at the top");
}

TEST(DocumentTest, BinaryGarbage) {
  EXPECT_CONTAINS(refusal(std::string("a: 1\n\0b", 7)), "scene.yaml:2: not a text file (byte 0)");
  EXPECT_CONTAINS(refusal("\x89HDF\r\n\x1a\n"), "scene.yaml:1: not a text file (byte 137)");
  EXPECT_EQ(refusal("title: caf\xc3\xa9"), "no exception");
}

TEST(DocumentTest, SyntaxErrorHasLineAndColumn) {
  EXPECT_CONTAINS(refusal("a: 1\nb: [1, 2\nc: 3\n"), "scene.yaml:3:");
  EXPECT_CONTAINS(refusal("a: 1\n\tb: 2\n"), "scene.yaml:2:1: not valid YAML");
  EXPECT_CONTAINS(refusal("a:\n\tb: 2\n"), "The file indents with tabs; use spaces.");
  EXPECT_CONTAINS(refusal("a: *nobody\n"), "scene.yaml:1:");
}

TEST(DocumentTest, LineEndsOfOtherSystems) {
  EXPECT_EQ(refusal("\xef\xbb\xbftitle: a\r\ntime:\r\n  end: 1\r\n"), "no exception");
}

TEST(DocumentTest, OneDocumentOnly) {
  EXPECT_CONTAINS(refusal("a: 1\n---\nb: 2\n"), "scene.yaml:2: a second document begins here; expected one.");
  EXPECT_EQ(refusal("---\na: 1\n...\n"), "no exception");
}

TEST(DocumentTest, BracketOrCommaTooManyEnds) {  // where yaml-cpp's LoadAll() would go on for ever
  for (const char* text : {"a: {b: 1}\n}", "a: [1, 2]]\nb: 1\n", "a: 1\n]", "}", "a: 1\n,", "a: {b: 1}}\n",
                           ",a: 1\n", "\"a\" , b\n"})
    EXPECT_CONTAINS(refusal(text), "scene.yaml:");
  EXPECT_CONTAINS(message_of<ConfigError>([] { Document::from_text("a: 1", "f").set("a=[1]]"); }),
                  "--set a=[1]]: the value is not valid YAML");
}

TEST(DocumentTest, EndlessAndDeepNestingEnd) {
  EXPECT_CONTAINS(refusal("a: &x [*x]\n"), "scene.yaml:1");
  std::string deep = "a: ";
  for (int i = 0; i < 400; ++i) deep += "[";
  for (int i = 0; i < 400; ++i) deep += "]";
  EXPECT_CONTAINS(refusal(deep), "scene.yaml:1: sections nested too deeply");
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int j = 1; j < 10; ++j) bomb += ", " + last;
    bomb += "]\n";
  }
  EXPECT_CONTAINS(refusal(bomb), "aliases (&, *) that repeat without end");
}

TEST(DocumentTest, ResolvesFilesBesideIt) {
  const Document document = Document::from_text("a: 1", "configs/wave/sph.yaml");
  EXPECT_EQ(document.resolve("scene.yaml"), "configs/wave/scene.yaml");
  EXPECT_EQ(document.resolve("../x.stl"), "configs/x.stl");
  EXPECT_EQ(document.resolve("/abs/x.stl"), "/abs/x.stl");
  EXPECT_EQ(Document::from_text("a: 1", "sph.yaml").resolve("scene.yaml"), "scene.yaml");
}

std::string setting_refusal(const std::string& assignment) {
  return message_of<ConfigError>(
      [&] { Document::from_text("time: {end: 1}\nblocks: [{n: 1}]\n", "fv.yaml").set(assignment); });
}

TEST(DocumentTest, MalformedSettings) {
  EXPECT_CONTAINS(setting_refusal("time.end"), "--set time.end: expected KEY=VALUE");
  EXPECT_CONTAINS(setting_refusal("=3"), "expected KEY=VALUE");
  EXPECT_CONTAINS(setting_refusal("time..end=3"), "'time..end' is not a key");
  EXPECT_CONTAINS(setting_refusal("time.=3"), "'time.' is not a key");
  EXPECT_CONTAINS(setting_refusal("blocks[x].n=3"), "is not a key");
  EXPECT_CONTAINS(setting_refusal("blocks[0=3"), "is not a key");
  EXPECT_CONTAINS(setting_refusal("[0]=3"), "is not a key");
  EXPECT_CONTAINS(setting_refusal("blocks[5].n=3"), "index 5 in a list of 1; the next free one is 1.");
  EXPECT_CONTAINS(setting_refusal("time.end.x=3"),
                  "cannot reach 'time.end.x': fv.yaml:1 has '1' on the way.");
  EXPECT_CONTAINS(setting_refusal("time[0]=3"), "cannot reach 'time[0]'");
  EXPECT_CONTAINS(setting_refusal("time.end=[1, 2"), "--set time.end=[1, 2: the value is not valid YAML");
  EXPECT_EQ(setting_refusal("blocks[1].n=3"), "no exception");
  EXPECT_EQ(setting_refusal("new.section.key=3"), "no exception");
}

}  // namespace
}  // namespace littoral::support
