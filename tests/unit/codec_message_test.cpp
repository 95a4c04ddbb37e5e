#include "burnish/core/codec_message.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(CodecMessage, IsTheFirstLineThatSaysSomething) {
  EXPECT_EQ(codec_message("end of file\nPNG read error: IDAT: end of file\nPNG library error\n", "a.png"),
            "end of file");
  EXPECT_EQ(codec_message("\n  \r\n damaged \t\r\nand more", "a.png"), "damaged");
  EXPECT_EQ(codec_message("one line", "a.png"), "one line");
  EXPECT_EQ(codec_message("", "a.png"), "");
  EXPECT_EQ(codec_message(" \n\n", "a.png"), "");
}

TEST(CodecMessage, NamesTheFileAsPeopleKnowIt) {
  const FileRef spooled("/tmp/.spooled", "standard input");
  EXPECT_EQ(codec_message("Cannot read \"/tmp/.spooled\": /tmp/.spooled ends.", spooled),
            "Cannot read \"standard input\": standard input ends.");
  EXPECT_EQ(codec_message("Cannot read a.png.", "a.png"), "Cannot read a.png.");
  EXPECT_EQ(codec_message("x and x", FileRef("x", "xx")), "xx and xx");
}

}  // namespace
}  // namespace burnish
