import lkao

V = [[-5, 0, -5], [5, 0, -5], [5, 0, 5], [-5, 0, 5], [-5, 0, 0], [5, 0, 0], [5, 5, 0], [-5, 5, 0]]
F = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]]  # a floor, and a wall on it
foot = lkao.occlusion(V, F, P=[[0, 0, 0.001]], N=[[0, 1, 0]], radius=2.0, samples=256)
print(f"occlusion at the foot of the wall: {foot[0]:.2f}")
