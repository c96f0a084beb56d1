"""SSIM of sRGB-encoded luma and RMSE in linear light of pairs of .npy images (A0 B0 A1 B1 ...), in double precision, a line a pair."""
import sys

import numpy as np
from skimage.metrics import structural_similarity


def luma(light):
    light = np.clip(light, 0, 1)
    code = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return code @ [0.2126, 0.7152, 0.0722]


images = [np.load(name).astype(np.float64) for name in sys.argv[1:]]
for a, b in zip(images[::2], images[1::2]):
    ssim = structural_similarity(luma(a), luma(b), gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1)
    print(repr(float(ssim)), repr(float(np.sqrt(np.mean((a - b) ** 2)))))
