#include "view/server/mailbox.h"

#include <gtest/gtest.h>

namespace lfdsim::view {
namespace {

TEST(Mailbox, TextsFirstAndInOrder) {
    Mailbox box;
    EXPECT_FALSE(box.next());
    EXPECT_FALSE(box.frame("one", "frame"));
    EXPECT_TRUE(box.text("a") && box.text("b"));
    for (const char* bytes : {"a", "b"}) {
        const auto item = box.next();
        ASSERT_TRUE(item);
        EXPECT_EQ(item->bytes, bytes);
        EXPECT_FALSE(item->binary);
    }
    EXPECT_TRUE(box.next()->binary);
    EXPECT_FALSE(box.next());
}

TEST(Mailbox, NewestFrameOfALane) {
    Mailbox box;
    EXPECT_FALSE(box.busy("left"));
    EXPECT_FALSE(box.frame("left", "1"));
    EXPECT_FALSE(box.frame("right", "2"));
    EXPECT_TRUE(box.frame("left", "3"));
    EXPECT_TRUE(box.busy("left") && box.busy("right"));
    EXPECT_EQ(box.next()->bytes, "3");
    EXPECT_TRUE(box.busy("left")) << "on its way";
    EXPECT_FALSE(box.frame("left", "4")) << "the one on its way is not dropped";
    EXPECT_EQ(box.next()->bytes, "2");
    EXPECT_TRUE(box.busy("left")) << "waits";
    EXPECT_EQ(box.next()->bytes, "4");
    EXPECT_FALSE(box.busy("right"));
    EXPECT_FALSE(box.next());
    EXPECT_FALSE(box.busy("left"));
}

TEST(Mailbox, BoundsOfTexts) {
    Mailbox many, large, taken;
    for (std::size_t k = 0; k < most_texts_waiting; ++k) ASSERT_TRUE(many.text("x"));
    EXPECT_FALSE(many.text("x"));
    EXPECT_FALSE(many.next()) << "nothing is kept for a connection that ends";
    EXPECT_TRUE(large.text(std::string(most_text_bytes_waiting, 'x')));
    EXPECT_FALSE(large.text("x"));
    for (std::size_t k = 0; k < 2 * most_texts_waiting; ++k) {
        ASSERT_TRUE(taken.text(std::string(100000, 'x')));
        taken.next();
    }
}

TEST(Mailbox, Closed) {
    Mailbox box;
    box.text("last words");
    box.frame("one", "x");
    box.close(false);
    EXPECT_FALSE(box.busy("one"));
    EXPECT_FALSE(box.frame("one", "x"));
    EXPECT_EQ(box.next()->bytes, "last words");
    EXPECT_FALSE(box.next());
    box.close(true);
    EXPECT_TRUE(box.text("x"));
    EXPECT_FALSE(box.next());
}

}  // namespace
}  // namespace lfdsim::view
