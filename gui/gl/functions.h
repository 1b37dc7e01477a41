#pragma once

#include <GL/glcorearb.h>

namespace patina {

// The functions of OpenGL 3.3 core that the program calls: name of the type, name of the function.
#define PATINA_GL_FUNCTIONS(F)                                      \
  F(ACTIVETEXTURE, ActiveTexture)                                   \
  F(ATTACHSHADER, AttachShader)                                     \
  F(BINDBUFFER, BindBuffer)                                         \
  F(BINDFRAMEBUFFER, BindFramebuffer)                               \
  F(BINDRENDERBUFFER, BindRenderbuffer)                             \
  F(BINDTEXTURE, BindTexture)                                       \
  F(BINDVERTEXARRAY, BindVertexArray)                               \
  F(BLENDEQUATION, BlendEquation)                                   \
  F(BLENDFUNC, BlendFunc)                                           \
  F(BLENDFUNCSEPARATE, BlendFuncSeparate)                           \
  F(BLITFRAMEBUFFER, BlitFramebuffer)                               \
  F(BUFFERDATA, BufferData)                                         \
  F(BUFFERSUBDATA, BufferSubData)                                   \
  F(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                 \
  F(CLEAR, Clear)                                                   \
  F(CLEARCOLOR, ClearColor)                                         \
  F(COMPILESHADER, CompileShader)                                   \
  F(CREATEPROGRAM, CreateProgram)                                   \
  F(CREATESHADER, CreateShader)                                     \
  F(DELETEBUFFERS, DeleteBuffers)                                   \
  F(DELETEFRAMEBUFFERS, DeleteFramebuffers)                         \
  F(DELETEPROGRAM, DeleteProgram)                                   \
  F(DELETERENDERBUFFERS, DeleteRenderbuffers)                       \
  F(DELETESHADER, DeleteShader)                                     \
  F(DELETETEXTURES, DeleteTextures)                                 \
  F(DELETEVERTEXARRAYS, DeleteVertexArrays)                         \
  F(DISABLE, Disable)                                               \
  F(DRAWARRAYS, DrawArrays)                                         \
  F(DRAWELEMENTS, DrawElements)                                     \
  F(DRAWELEMENTSBASEVERTEX, DrawElementsBaseVertex)                 \
  F(ENABLE, Enable)                                                 \
  F(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)               \
  F(FINISH, Finish)                                                 \
  F(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)               \
  F(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                     \
  F(GENBUFFERS, GenBuffers)                                         \
  F(GENERATEMIPMAP, GenerateMipmap)                                 \
  F(GENFRAMEBUFFERS, GenFramebuffers)                               \
  F(GENRENDERBUFFERS, GenRenderbuffers)                             \
  F(GENTEXTURES, GenTextures)                                       \
  F(GENVERTEXARRAYS, GenVertexArrays)                               \
  F(GETERROR, GetError)                                             \
  F(GETINTEGERV, GetIntegerv)                                       \
  F(GETPROGRAMINFOLOG, GetProgramInfoLog)                           \
  F(GETPROGRAMIV, GetProgramiv)                                     \
  F(GETSHADERINFOLOG, GetShaderInfoLog)                             \
  F(GETSHADERIV, GetShaderiv)                                       \
  F(GETSTRING, GetString)                                           \
  F(GETTEXIMAGE, GetTexImage)                                       \
  F(GETUNIFORMLOCATION, GetUniformLocation)                         \
  F(LINKPROGRAM, LinkProgram)                                       \
  F(PIXELSTOREI, PixelStorei)                                       \
  F(READPIXELS, ReadPixels)                                         \
  F(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) \
  F(SCISSOR, Scissor)                                               \
  F(SHADERSOURCE, ShaderSource)                                     \
  F(TEXIMAGE2D, TexImage2D)                                         \
  F(TEXPARAMETERI, TexParameteri)                                   \
  F(TEXSUBIMAGE2D, TexSubImage2D)                                   \
  F(UNIFORM1F, Uniform1f)                                           \
  F(UNIFORM1I, Uniform1i)                                           \
  F(UNIFORM2F, Uniform2f)                                           \
  F(UNIFORM3F, Uniform3f)                                           \
  F(UNIFORMMATRIX4FV, UniformMatrix4fv)                             \
  F(USEPROGRAM, UseProgram)                                         \
  F(VERTEXATTRIBPOINTER, VertexAttribPointer)                       \
  F(VIEWPORT, Viewport)

/// The table of GL functions of one context. Passed by reference; every GL object holds the table it was made
/// with and must die before it, on the thread where its context is current.
struct Gl {
  using Loader = void* (*)(const char* name);

  /// @param loader  the context's own look-up, for example OSMesaGetProcAddress; its context is current
  /// @throws UserError naming a function that the driver lacks
  explicit Gl(Loader loader);

#define PATINA_GL_DECLARE(TYPE, Name) PFNGL##TYPE##PROC Name = nullptr;
  PATINA_GL_FUNCTIONS(PATINA_GL_DECLARE)
#undef PATINA_GL_DECLARE

  /// Who draws, in the driver's words: "llvmpipe (LLVM 15.0.6, 256 bits)".
  const char* renderer_name() const;
};

}  // namespace patina
