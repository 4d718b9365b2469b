import cProfile,pstats,time,numpy as np,open3d as o3d
from engine3d.compat.open3d import Visualizer
m=o3d.geometry.TriangleMesh.create_torus(radial_resolution=200,tubular_resolution=200); m.compute_vertex_normals()
v=Visualizer(); v.create_window(width=640,height=480,visible=False); v.add_geometry(m)
def f(n):
    for i in range(n):
        v.get_view_control().rotate(5,0); v.capture_screen_float_buffer(True)
f(2); t=time.process_time(); w=time.time(); f(5); print((time.process_time()-t)/5*1e3,(time.time()-w)/5*1e3)
p=cProfile.Profile(); p.runcall(f,5); pstats.Stats(p).sort_stats('tottime').print_stats(14)
pc=o3d.geometry.PointCloud(o3d.utility.Vector3dVector(np.random.rand(10000,3)))
t=time.time()
for i in range(30):
    v=Visualizer(); v.create_window(width=224,height=224,visible=False); v.add_geometry(pc); v.capture_screen_float_buffer(do_render=True); v.destroy_window()
print((time.time()-t)/30*1e3,'ms a cloud')
