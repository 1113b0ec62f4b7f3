"""The time of a refit as a sum of counts, each with a cost: nodes, and vertices of leaves."""

import statistics


class Fitted:
    def __init__(self, costs, observations):
        self.costs = costs
        self.median_error = statistics.median(
            abs(sum(cost * count for cost, count in zip(costs, counts)) - time) / time for counts, time in observations)


def fit(observations):
    """The costs with the least sum of squared relative differences (normal equations), or None if they are not determined.

    An observation is a tuple of counts, and the time.
    """
    size = len(observations[0][0]) if observations else 0
    scaled = [[count / time for count in counts] for counts, time in observations]
    matrix = [[sum(row[i] * row[j] for row in scaled) for j in range(size)] + [sum(row[i] for row in scaled)] for i in range(size)]
    for column in range(size):
        pivot = max(range(column, size), key=lambda row: abs(matrix[row][column]))
        if abs(matrix[pivot][column]) <= 1e-9 * sum(row[column] ** 2 for row in scaled):
            return None
        matrix[column], matrix[pivot] = matrix[pivot], matrix[column]
        for row in range(size):
            if row != column:
                factor = matrix[row][column] / matrix[column][column]
                matrix[row] = [a - factor * b for a, b in zip(matrix[row], matrix[column])]
    return Fitted([matrix[i][size] / matrix[i][i] for i in range(size)], observations) if size else None
