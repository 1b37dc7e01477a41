#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gui/crop_drag.h"
#include "gui/preview/clipping.h"

namespace patina {
namespace {

constexpr int kWidth = 400, kHeight = 300;
constexpr PhotoCrop kStart{100, 80, 120};

PhotoCrop dragged(CropHandle handle, double right, double down) {
  return dragged_crop(kStart, handle, right, down, kWidth, kHeight);
}

TEST(CropDragTest, InsideItMovesAndStopsAtTheEdges) {
  EXPECT_EQ(dragged(CropHandle::inside, 30, -20), (PhotoCrop{130, 60, 120}));
  EXPECT_EQ(dragged(CropHandle::inside, 9999, 9999), (PhotoCrop{280, 180, 120}));
  EXPECT_EQ(dragged(CropHandle::inside, -9999, -9999), (PhotoCrop{0, 0, 120}));
  EXPECT_EQ(dragged(CropHandle::none, 30, 30), kStart);
}

TEST(CropDragTest, ACornerFollowsTheMouseAndTheOppositeOneStays) {
  EXPECT_EQ(dragged(CropHandle::bottom_right, 20, 20), (PhotoCrop{100, 80, 140}));
  EXPECT_EQ(dragged(CropHandle::top_left, 20, 20), (PhotoCrop{120, 100, 100}));
  EXPECT_EQ(dragged(CropHandle::top_right, 20, -20), (PhotoCrop{100, 60, 140}));
  EXPECT_EQ(dragged(CropHandle::bottom_left, 20, -20), (PhotoCrop{120, 80, 100}));
}

TEST(CropDragTest, WhateverIsDraggedTheSquareCanBeUsed) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> far(-700, 700);
  PhotoCrop crop = kStart;
  for (int i = 0; i < 5000; ++i) {
    const auto handle = static_cast<CropHandle>(rng() % 6);
    crop = dragged_crop(crop, handle, far(rng), far(rng), kWidth, kHeight);
    ASSERT_GE(crop.x, 0);
    ASSERT_GE(crop.y, 0);
    ASSERT_LE(crop.x + crop.side, kWidth);
    ASSERT_LE(crop.y + crop.side, kHeight);
    ASSERT_GE(crop.side, kMinPhotoSide);
  }
}

TEST(CropDragTest, HandlesAreWhereTheyAreSeen) {
  EXPECT_EQ(crop_handle_at(kStart, 102, 79, 5), CropHandle::top_left);
  EXPECT_EQ(crop_handle_at(kStart, 221, 82, 5), CropHandle::top_right);
  EXPECT_EQ(crop_handle_at(kStart, 97, 203, 5), CropHandle::bottom_left);
  EXPECT_EQ(crop_handle_at(kStart, 219, 199, 5), CropHandle::bottom_right);
  EXPECT_EQ(crop_handle_at(kStart, 160, 140, 5), CropHandle::inside);
  EXPECT_EQ(crop_handle_at(kStart, 160, 60, 5), CropHandle::none);
}

TEST(ClippingTest, CoversWhatIsWhiteInAnyChannelAndNothingElse) {
  Image photo(10, 10, 3);
  for (float& value : photo.pixels) value = 0.98f;
  photo.at(2, 3, 1) = 1;
  photo.at(7, 7, 0) = 254.0f / 255;
  const Image overlay = clipped_overlay(photo);
  EXPECT_EQ(overlay.at(2, 3, 3), 1);
  EXPECT_EQ(overlay.at(7, 7, 3), 1);
  EXPECT_EQ(overlay.at(3, 2, 3), 0);
  EXPECT_DOUBLE_EQ(covered_share(overlay), 0.02);
}

}  // namespace
}  // namespace patina
