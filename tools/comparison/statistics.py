"""Figures of a picture's texture, as `echoloop validate` takes them: an image is a list of rows of words."""
import math


def mean(words):
    return sum(words) / len(words)


def deviation(words):
    middle = mean(words)
    return math.sqrt(sum((w - middle) ** 2 for w in words) / len(words))


def texture(image, reach=10):
    """What is left of each word after the mean of the words up to `reach` rows and columns away."""
    rows, columns = len(image), len(image[0])
    sums = [[0.0] * (columns + 1)]  # of all words above and to the left
    for row in image:
        line, above = [0.0], sums[-1]
        total = 0.0
        for column, word in enumerate(row):
            total += word
            line.append(total + above[column + 1])
        sums.append(line)
    left = []
    for r in range(rows):
        top, end = max(r - reach, 0), min(r + reach + 1, rows)
        line = []
        for c in range(columns):
            a, b = max(c - reach, 0), min(c + reach + 1, columns)
            around = sums[end][b] - sums[top][b] - sums[end][a] + sums[top][a]
            line.append(image[r][c] - around / ((end - top) * (b - a)))
        left.append(line)
    return left


def variation(image):
    """Coefficient of variation of the texture; infinite for an image of zeros."""
    middle = mean([w for row in image for w in row])
    return deviation([w for row in texture(image) for w in row]) / middle if middle else math.inf


def likeness(image, down, across):
    """Correlation of an image's texture with itself, that many rows down and columns across; 0 for an even one."""
    t = texture(image)
    pairs = [(t[r][c], t[r + down][c + across]) for r in range(len(t) - down) for c in range(len(t[0]) - across)]
    a, b = mean([p for p, _ in pairs]), mean([q for _, q in pairs])
    spread = math.sqrt(sum((p - a) ** 2 for p, _ in pairs) * sum((q - b) ** 2 for _, q in pairs))
    return sum((p - a) * (q - b) for p, q in pairs) / spread if spread else 0.0


def decibels(ratio):
    return 10 * math.log10(ratio)
