#!/usr/bin/env python3
"""Feature maps of a network by PyTorch in double precision, for network_parity_test.cpp.

    reference_features.py vgg19 FOLDER               a VGG-19 of random weights, in every layout that it is published in
    reference_features.py distilled WEIGHTS FOLDER   the distilled VGG-19 of a .safetensors file

Into FOLDER: image.f32 (3 x SIDE x SIDE, sRGB in [0,1]), features-K.f64 (one file a tap, raw) and, for vgg19,
vgg19.pth, vgg19-legacy.pth, vgg19.safetensors. Needs python3-torch and python3-numpy.
"""
import collections
import json
import os
import struct
import sys

import numpy as np
import torch
import torch.nn.functional as F

SIDE = 80
BLOCKS = ((2, 64), (2, 128), (4, 256), (4, 512), (4, 512))


def conv(x, weight, bias, relu=True):
    pad = weight.shape[2] // 2
    y = F.conv2d(F.pad(x, (pad, pad, pad, pad), mode="reflect") if pad else x, weight.double(), bias.double())
    return torch.relu(y) if relu else y


def random_vgg19():
    """Torchvision's names; He's scale, so that no layer dies; one tensor that is not a convolution's."""
    state = collections.OrderedDict()
    inputs, module = 3, 0
    for block, (convolutions, channels) in enumerate(BLOCKS):
        for _ in range(convolutions):
            deviation = (2 / (9 * inputs)) ** 0.5
            state[f"features.{module}.weight"] = deviation * torch.randn(channels, inputs, 3, 3)
            state[f"features.{module}.bias"] = 0.1 * torch.randn(channels)
            inputs, module = channels, module + 2
        module += 1
    state["classifier.6.bias"] = torch.randn(1000)
    return state


def vgg19_features(image, state):
    mean = torch.tensor([0.485, 0.456, 0.406]).double().view(1, 3, 1, 1)
    std = torch.tensor([0.229, 0.224, 0.225]).double().view(1, 3, 1, 1)
    x, features, module = (image - mean) / std, [], 0
    for block, (convolutions, _) in enumerate(BLOCKS):
        if block:
            x = F.avg_pool2d(x, 2)
            module += 1
        for _ in range(convolutions):
            x = conv(x, state[f"features.{module}.weight"], state[f"features.{module}.bias"])
            module += 2
        features.append(x)
    return features


def distilled_features(image, state):
    def layer(x, name, relu=True):
        return conv(x, state[name + ".weight"], state[name + ".bias"], relu)

    x, features = layer(image, "conv0", relu=False), []
    for block, convolutions in enumerate((2, 2, 4, 4, 1), 1):
        for i in range(1, convolutions + 1):
            x = layer(x, f"conv{block}{i}")
            if i == 1:
                features.append(layer(x, f"conv{block}1_aux"))
        x = F.max_pool2d(x, 2)
    return features


def read_safetensors(path):
    with open(path, "rb") as file:
        header = json.loads(file.read(struct.unpack("<Q", file.read(8))[0]))
        data = file.read()
    header.pop("__metadata__", None)
    return {name: torch.from_numpy(np.frombuffer(data[slice(*entry["data_offsets"])], "<f4").reshape(entry["shape"]).copy())
            for name, entry in header.items()}


def write_safetensors(path, state):
    header, data = {}, b""
    for name, tensor in state.items():
        raw = tensor.numpy().tobytes()
        header[name] = {"dtype": "F32", "shape": list(tensor.shape), "data_offsets": [len(data), len(data) + len(raw)]}
        data += raw
    text = json.dumps(header).encode()
    with open(path, "wb") as file:
        file.write(struct.pack("<Q", len(text)) + text + data)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    torch.manual_seed(1)
    kind, folder = sys.argv[1], sys.argv[-1]
    image = torch.rand(3, SIDE, SIDE)
    image.numpy().tofile(os.path.join(folder, "image.f32"))
    if kind == "vgg19":
        state = random_vgg19()
        torch.save(state, os.path.join(folder, "vgg19.pth"))
        torch.save(state, os.path.join(folder, "vgg19-legacy.pth"), _use_new_zipfile_serialization=False)
        write_safetensors(os.path.join(folder, "vgg19.safetensors"), state)
        features = vgg19_features(image.double()[None], state)
    else:
        features = distilled_features(image.double()[None], read_safetensors(sys.argv[2]))
    for k, feature in enumerate(features):
        feature.numpy().tofile(os.path.join(folder, f"features-{k}.f64"))


if __name__ == "__main__":
    main()
