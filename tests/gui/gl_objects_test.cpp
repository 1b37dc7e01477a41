// GL objects hold what they are given, and refuse in words what they cannot do.

#include <cstring>
#include <random>
#include <string>

#include "engine/error.h"
#include "gl_fixture.h"
#include "gui/gl/objects.h"

namespace patina {
namespace {

Image noise(int width, int height, int channels, float low, float high) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(low, high);
  Image image(width, height, channels);
  for (float& value : image.pixels) value = uniform(random);
  return image;
}

TEST_F(GlTest, FloatTexturesComeBackBitForBit) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image given = noise(13, 7, channels, -1e3f, 1e3f);
    const Image read = Texture::floats(gl(), given).read();
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 13; ++column) {
        for (int c = 0; c < channels; ++c) {
          ASSERT_EQ(read.at(row, column, c), given.at(row, column, c)) << channels << " channels";
        }
      }
    }
  }
}

TEST_F(GlTest, UpdatingAFloatTextureReplacesItsContents) {
  Texture texture = Texture::floats(gl(), noise(5, 3, 1, 0, 1));
  const Image later = noise(5, 3, 1, 5, 6);
  texture.update(later);
  EXPECT_EQ(texture.read().at(2, 4, 0), later.at(2, 4, 0));
}

TEST_F(GlTest, PicturesComeBackRoundedToBytesAndClamped) {
  const Image given = noise(9, 5, 3, -0.5f, 1.5f);
  const Image read = Texture::picture(gl(), given).read();
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 9; ++column) {
      for (int c = 0; c < 3; ++c) {
        const float wanted = std::round(255 * std::clamp(given.at(row, column, c), 0.0f, 1.0f)) / 255;
        ASSERT_FLOAT_EQ(read.at(row, column, c), wanted);
      }
      ASSERT_EQ(read.at(row, column, 3), 1) << "opaque";
    }
  }
}

TEST_F(GlTest, AGreyPictureIsGrey) {
  Image grey(1, 1, 1);
  grey.at(0, 0, 0) = 0.4f;
  const Image read = Texture::picture(gl(), grey).read();
  EXPECT_EQ(pixel(read, 0, 0), (Rgb{102, 102, 102}));
}

TEST_F(GlTest, AFramebufferKeepsItsClearColour) {
  Framebuffer target(gl(), 6, 4);
  target.bind();
  gl().ClearColor(0.2f, 0.4f, 0.6f, 1);
  gl().Clear(GL_COLOR_BUFFER_BIT);
  const Image read = target.read();
  EXPECT_EQ(read.width, 6);
  EXPECT_EQ(read.height, 4);
  EXPECT_EQ(pixel(read, 3, 5), (Rgb{51, 102, 153}));
}

TEST_F(GlTest, MovedObjectsDeleteTheirNameOnce) {
  Texture first = Texture::floats(gl(), noise(4, 4, 1, 0, 1));
  const GLuint name = first.name();
  Texture second = std::move(first);
  EXPECT_EQ(second.name(), name);
  EXPECT_EQ(first.name(), 0u);
  second = Texture::floats(gl(), noise(2, 2, 1, 0, 1));
  EXPECT_EQ(second.read().width, 2);
  EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

/// The sentence with which a program is refused.
std::string refusal(const Gl& gl, const std::string& vertex, const std::string& fragment) {
  try {
    const Program program(gl, "sample", vertex, fragment);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

const std::string kVertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
const std::string kFragment = "#version 330 core\nout vec4 color;\nvoid main() { color = vec4(1.0); }\n";

TEST_F(GlTest, AProgramThatCompilesIsAccepted) { EXPECT_EQ(refusal(gl(), kVertex, kFragment), ""); }

TEST_F(GlTest, AShaderThatDoesNotCompileIsRefusedInOneSentence) {
  const std::string words = refusal(gl(), kVertex, "#version 330 core\nvoid main() { colour = 1; }\n");
  EXPECT_NE(words.find("fragment shader \"sample\""), std::string::npos) << words;
  EXPECT_NE(words.find("colour"), std::string::npos) << words << " (names the mistake)";
  EXPECT_EQ(words.find('\n'), std::string::npos) << words;
  EXPECT_EQ(words.back(), '.');
}

TEST_F(GlTest, ShadersThatDoNotFitEachOtherAreRefused) {
  const std::string gives_two =
      "#version 330 core\nout vec2 v;\nvoid main() { v = vec2(0.0); gl_Position = vec4(0.0); }\n";
  const std::string takes_three =
      "#version 330 core\nin vec3 v;\nout vec4 color;\nvoid main() { color = vec4(v, 1.0); }\n";
  const std::string words = refusal(gl(), gives_two, takes_three);
  EXPECT_NE(words.find("link"), std::string::npos) << words;
}

TEST_F(GlTest, APictureLargerThanTheDriverHoldsIsRefused) {
  try {
    Texture::rgba8(gl(), 1 << 20, 1, {}, TextureFilter::linear);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("1048576 x 1 pixels"), std::string::npos) << error.what();
  }
}

TEST(GlFunctionsTest, AMissingFunctionIsNamed) {
  try {
    const Gl gl([](const char* name) -> void* {
      return std::strcmp(name, "glViewport") == 0 ? nullptr : reinterpret_cast<void*>(1);
    });
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("glViewport"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace patina
